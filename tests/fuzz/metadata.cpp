// Metadata of a picture: lines NAME=VALUE. They survive the file, and a reference of converge takes or refuses them.
#include <sstream>

#include "image/layered_image.h"
#include "measure/converge/reference.h"
#include "target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace diptych::core;
    static const fuzz::InputFile file("picture.exr");
    LayeredImage picture;
    picture.color = make_image(1, 1, 3);
    std::istringstream lines(std::string(data, data + size));
    for (std::string line; std::getline(lines, line);) {
        const std::size_t equals = std::min(line.find('='), line.size());
        picture.metadata[line.substr(0, equals)] = equals < line.size() ? line.substr(equals + 1) : "";
    }
    fuzz::must_load_or_refuse(file.path(), [&] {
        write_exr(file.path(), picture);
        reference_of(read_image(file.path()), file.path().string());
    });
    return 0;
}
