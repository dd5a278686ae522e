#include "measure/converge/pictures.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "image/figures.h"
#include "image/image_file.h"
#include "image/tonemap_image.h"

namespace diptych::core {

namespace {

constexpr float least_error = -3, greatest_error = 1, error_levels = 24;  // log10 of the relative error

/// Every n-th pixel as it is, not averaged: what is looked at is the noise.
Image thinned(const Image& image, int largest_side) {
    const int step = (std::max(image.width, image.height) + largest_side - 1) / largest_side;
    if (step <= 1) {
        return image;
    }
    Image thin = make_image(image.width / step, image.height / step, image.channels);
    for (int y = 0; y < thin.height; ++y) {
        for (int x = 0; x < thin.width; ++x) {
            for (int channel = 0; channel < image.channels; ++channel) {
                thin.at(x, y, channel) = image.at(x * step + step / 2, y * step + step / 2, channel);
            }
        }
    }
    return thin;
}

Image shown(const Image& color, double exposure, int largest_side) {
    return thinned(tonemapped(color, default_tonemap, static_cast<float>(exposure)), largest_side);
}

/// The relative error of each pixel in steps of a sixth of a decade: few colours make a small file.
Image error_map(const Image& color, const Image& reference, int largest_side) {
    Image error = thinned(relative_difference(color, reference), largest_side);
    for (float& value : error.data) {
        const float level = (std::log10(std::max(value, 1e-30F)) - least_error) / (greatest_error - least_error);
        value = std::floor(std::clamp(level, 0.0F, 1.0F) * error_levels) / error_levels;
    }
    return heatmap(error, 0, 1);
}

/// Whole stops that bring the reference's mean near a fifth of white, and leave scenes of ordinary brightness as they
/// are. Emitters, which may be as bright as they like, count for little.
double exposure_of(const Image& reference) {
    double sum = 0;
    for (const float value : reference.data) {
        sum += std::min(value, 2.0F);
    }
    const double mean = sum / static_cast<double>(reference.data.size());
    return mean > 0 ? std::clamp(std::round(std::log2(0.2 / mean)), -12.0, 12.0) : 0;
}

}  // namespace

void write_page_pictures(const std::vector<Method>& methods, const ReferencePicture& reference, int largest_side,
                         const ConvergeState& state) {
    std::filesystem::create_directories(state.path("pictures"));
    const Image& truth = reference.image.color;
    const double exposure = exposure_of(truth);
    write_png(state.path("pictures/reference.png"), shown(truth, exposure, largest_side));
    for (const Method& method : methods) {
        const std::string stem = state.path("pictures/" + file_stem(method.name));
        if (state.picture(method.name) && std::filesystem::exists(stem + ".exr")) {
            const Image color = read_image(stem + ".exr").color;
            write_png(stem + ".png", shown(color, exposure, largest_side));
            write_png(stem + "-error.png", error_map(color, truth, largest_side));
        }
    }
}

}  // namespace diptych::core
