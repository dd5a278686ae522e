// glTF, text or binary: loads, or is refused in one line.
#include "gltf/import.h"
#include "target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace diptych::core;
    static const fuzz::InputFile file("scene.gltf");
    const auto& path = file.write({data, size});
    fuzz::must_load_or_refuse(path, [&] {
        GltfOptions options;
        options.memory_limit = fuzz::memory_limit;
        load_gltf(path, options);
    });
    return 0;
}
