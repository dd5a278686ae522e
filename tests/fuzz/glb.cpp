// The same as gltf.cpp for a binary file whose header fits, so that every input reaches the JSON and the binary chunk:
// what lies before the first zero byte is the JSON, and what lies behind it the binary chunk.
#include <algorithm>
#include <vector>

#include "gltf/import.h"
#include "target.h"

namespace {

using Bytes = std::vector<std::uint8_t>;

void put(Bytes& bytes, std::uint32_t value) {
    for (int i = 0; i < 4; ++i) {
        bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
    }
}

void put_chunk(Bytes& bytes, std::uint32_t type, std::span<const std::uint8_t> data) {
    put(bytes, static_cast<std::uint32_t>(data.size()));
    put(bytes, type);
    bytes.insert(bytes.end(), data.begin(), data.end());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace diptych::core;
    static const fuzz::InputFile file("scene.glb");
    const std::span<const std::uint8_t> input(data, size);
    const auto json = static_cast<std::size_t>(std::find(input.begin(), input.end(), 0) - input.begin());
    Bytes bytes;
    put(bytes, 0x46546C67);
    put(bytes, 2);
    put(bytes, static_cast<std::uint32_t>(size - (json < size ? 1 : 0) + 12 + 16));
    put_chunk(bytes, 0x4E4F534A, input.first(json));
    put_chunk(bytes, 0x004E4942, input.subspan(std::min(json + 1, size)));
    const auto& path = file.write(bytes);
    fuzz::must_load_or_refuse(path, [&] {
        GltfOptions options;
        options.memory_limit = fuzz::memory_limit;
        load_gltf(path, options);
    });
    return 0;
}
