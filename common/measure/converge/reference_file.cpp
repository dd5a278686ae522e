#include <fmt/format.h>

#include <cmath>

#include "error.h"
#include "image/image_file.h"
#include "measure/converge/reference.h"

namespace diptych::core {

ReferencePicture checked_reference(LayeredImage image, const std::string& name, int width, int height) {
    if (image.color.width != width || image.color.height != height) {
        throw Error(fmt::format("`reference` {}: has {}x{} pixels, but {}x{} are rendered; give `size`", name,
                                image.color.width, image.color.height, width, height));
    }
    if (image.data != image.display) {
        throw Error(fmt::format("`reference` {}: is a crop: it has data for {}x{} of its {}x{} pixels", name,
                                image.data.width, image.data.height, width, height));
    }
    for (const float value : image.color.data) {
        if (!std::isfinite(value)) {
            throw Error(fmt::format("`reference` {}: holds values that are not finite", name));
        }
    }
    return reference_of(std::move(image), name);
}

ReferencePicture load_reference(const std::string& path, int width, int height, std::uint64_t memory_limit) {
    return checked_reference(read_image(path, "", memory_limit), path, width, height);
}

}  // namespace diptych::core
