#include "gltf/encode_image.h"

#include <algorithm>
#include <stdexcept>

#include "error.h"
#include "image/image_library.h"

namespace diptych::core::gltf {

std::vector<std::uint8_t> encode_image(const TextureImage& image) {
    const std::size_t texels =
        static_cast<std::size_t>(std::max(image.width, 0)) * static_cast<std::size_t>(std::max(image.height, 0));
    if (texels == 0 || image.rgba.size() != 4 * texels) {
        throw Error("image '" + image.name + "': the number of texels does not fit its size");
    }
    bool opaque = true;
    for (std::size_t i = 0; i < texels; ++i) {
        opaque = opaque && image.rgba[4 * i + 3] == 255;
    }
    ByteImage codes{image.width, image.height, opaque ? 3 : 4, {}};
    for (std::size_t i = 0; i < 4 * texels; ++i) {
        if (!opaque || i % 4 != 3) {
            codes.data.push_back(image.rgba[i]);
        }
    }
    try {
        return image_library().encode_png(codes, false);
    } catch (const std::runtime_error& error) {
        throw Error("image '" + image.name + "': cannot be encoded: " + error.what());
    }
}

}  // namespace diptych::core::gltf
