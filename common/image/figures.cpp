#include "image/figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "error.h"
#include "film/magma.h"

namespace diptych::core {
namespace {

using PixelColor = std::array<float, 3>;

#define MAGMA_ENTRY(r, g, b) PixelColor{r, g, b},
constexpr std::array magma = {MAGMA_ENTRIES(MAGMA_ENTRY)};
#undef MAGMA_ENTRY
constexpr PixelColor nonfinite_color = {0.0f, 1.0f, 1.0f};

PixelColor magma_at(float t) {
    const float position = t * static_cast<float>(magma.size() - 1);
    const size_t low = std::min(static_cast<size_t>(position), magma.size() - 2);
    const float weight = position - static_cast<float>(low);
    PixelColor color;
    for (size_t channel = 0; channel < 3; ++channel) {
        color[channel] = magma[low][channel] * (1.0f - weight) + magma[low + 1][channel] * weight;
    }
    return color;
}

}  // namespace

Image relative_difference(const Image& a, const Image& b) {
    if (!a.same_shape(b)) {
        throw Error("the pictures cannot be compared: they differ in size or channels");
    }
    Image result = make_image(a.width, a.height, 1);
    const size_t channels = static_cast<size_t>(a.channels);
    for (size_t pixel = 0; pixel < result.pixel_count(); ++pixel) {
        double sum = 0.0;
        for (size_t channel = 0; channel < channels; ++channel) {
            const double value_a = a.data[pixel * channels + channel], value_b = b.data[pixel * channels + channel];
            const double difference = value_a - value_b;
            sum += difference * difference / (value_b * value_b + 1e-2);
        }
        result.data[pixel] = static_cast<float>(std::sqrt(sum / static_cast<double>(channels)));
    }
    return result;
}

Image heatmap(const Image& scalar, float lo, float hi) {
    if (scalar.channels != 1) {
        throw Error("a heatmap needs 1 channel, the image has " + std::to_string(scalar.channels));
    }
    if (!(lo < hi)) {
        throw Error("a heatmap needs a range with low < high");
    }
    Image result = make_image(scalar.width, scalar.height, 3);
    for (size_t pixel = 0; pixel < scalar.data.size(); ++pixel) {
        const float value = scalar.data[pixel];
        const PixelColor color =
            std::isfinite(value) ? magma_at(std::clamp((value - lo) / (hi - lo), 0.0f, 1.0f)) : nonfinite_color;
        std::copy(color.begin(), color.end(), result.data.begin() + static_cast<std::ptrdiff_t>(3 * pixel));
    }
    return result;
}

Image side_by_side(const std::vector<Image>& panels, int gap) {
    if (panels.empty()) {
        throw Error("side by side: there is no panel");
    }
    int width = gap * static_cast<int>(panels.size() - 1);
    for (const Image& panel : panels) {
        if (panel.height != panels[0].height || panel.channels != panels[0].channels) {
            throw Error("side by side: the panels differ in height or channels");
        }
        width += panel.width;
    }
    Image result = make_image(width, panels[0].height, panels[0].channels, 1.0f);
    for (int y = 0; y < result.height; ++y) {
        int x = 0;
        for (const Image& panel : panels) {
            const auto row = panel.data.begin() + static_cast<std::ptrdiff_t>(panel.index(0, y, 0));
            std::copy(row, row + static_cast<std::ptrdiff_t>(panel.width) * panel.channels,
                      result.data.begin() + static_cast<std::ptrdiff_t>(result.index(x, y, 0)));
            x += panel.width + gap;
        }
    }
    return result;
}

}  // namespace diptych::core
