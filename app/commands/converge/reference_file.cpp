#include <fmt/format.h>

#include <cmath>

#include "commands/converge/plan.h"
#include "error.h"
#include "image/image_file.h"

namespace diptych::core::app {

ReferencePicture load_reference(const std::string& path, int width, int height, std::uint64_t memory_limit) {
    LayeredImage image = read_image(path, "", memory_limit);
    if (image.color.width != width || image.color.height != height) {
        throw Error(fmt::format("--reference {}: has {}x{} pixels, but {}x{} are rendered; give --size", path,
                                image.color.width, image.color.height, width, height));
    }
    if (image.data != image.display) {
        throw Error(fmt::format("--reference {}: is a crop: it has data for {}x{} of its {}x{} pixels", path,
                                image.data.width, image.data.height, width, height));
    }
    for (const float value : image.color.data) {
        if (!std::isfinite(value)) {
            throw Error(fmt::format("--reference {}: holds values that are not finite", path));
        }
    }
    return reference_of(std::move(image), path);
}

}  // namespace diptych::core::app
