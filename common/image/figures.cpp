#include "image/figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "error.h"

namespace diptych {
namespace {

using Rgb = std::array<float, 3>;

// Every 17th of the 256 entries of 'magma': linear interpolation between them errs by less than a code of 8 bits or
// two.
constexpr std::array<Rgb, 16> magma = {{
    {0.001462f, 0.000466f, 0.013866f},
    {0.043830f, 0.033830f, 0.141886f},
    {0.123833f, 0.067295f, 0.295879f},
    {0.232077f, 0.059889f, 0.437695f},
    {0.341482f, 0.080564f, 0.492631f},
    {0.445163f, 0.122724f, 0.506901f},
    {0.550287f, 0.161158f, 0.505719f},
    {0.658483f, 0.196027f, 0.490253f},
    {0.767398f, 0.233705f, 0.457755f},
    {0.868793f, 0.287728f, 0.409303f},
    {0.944006f, 0.377643f, 0.365136f},
    {0.981000f, 0.498428f, 0.369734f},
    {0.994738f, 0.624350f, 0.427397f},
    {0.997228f, 0.747981f, 0.516859f},
    {0.993170f, 0.870024f, 0.626189f},
    {0.987053f, 0.991438f, 0.749504f},
}};
constexpr Rgb nonfinite_color = {0.0f, 1.0f, 1.0f};

Rgb magma_at(float t) {
    const float position = t * static_cast<float>(magma.size() - 1);
    const size_t low = std::min(static_cast<size_t>(position), magma.size() - 2);
    const float weight = position - static_cast<float>(low);
    Rgb color;
    for (size_t channel = 0; channel < 3; ++channel)
        color[channel] = magma[low][channel] * (1.0f - weight) + magma[low + 1][channel] * weight;
    return color;
}

}  // namespace

Image relative_difference(const Image& a, const Image& b) {
    if (!a.same_shape(b))
        throw Error("the pictures cannot be compared: they differ in size or channels");
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
    if (scalar.channels != 1)
        throw Error("a heatmap needs 1 channel, the image has " + std::to_string(scalar.channels));
    if (!(lo < hi))
        throw Error("a heatmap needs a range with low < high");
    Image result = make_image(scalar.width, scalar.height, 3);
    for (size_t pixel = 0; pixel < scalar.data.size(); ++pixel) {
        const float value = scalar.data[pixel];
        const Rgb color =
            std::isfinite(value) ? magma_at(std::clamp((value - lo) / (hi - lo), 0.0f, 1.0f)) : nonfinite_color;
        std::copy(color.begin(), color.end(), result.data.begin() + static_cast<std::ptrdiff_t>(3 * pixel));
    }
    return result;
}

Image side_by_side(const std::vector<Image>& panels, int gap) {
    if (panels.empty())
        throw Error("side by side: there is no panel");
    int width = gap * static_cast<int>(panels.size() - 1);
    for (const Image& panel : panels) {
        if (panel.height != panels[0].height || panel.channels != panels[0].channels)
            throw Error("side by side: the panels differ in height or channels");
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

}  // namespace diptych
