#include "image/metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "error.h"

namespace diptych::core {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

struct PixelError {
    double relative;  // sum over the channels of (a-b)^2 / (b^2 + 1e-2)
    double energy;    // sum over the channels of |a|
};

bool all_finite(const float* rgb) {
    return std::isfinite(rgb[0]) && std::isfinite(rgb[1]) && std::isfinite(rgb[2]);
}

bool nearly_equal(double a, double b) {
    return std::abs(a - b) <= 1e-3 * std::max(std::abs(a), std::abs(b)) + 1e-6;
}

double z_of(double mean_a, double mean_b, double standard_error) {
    const double difference = mean_a - mean_b;
    if (difference == 0.0 && standard_error == 0.0) {
        return 0.0;
    }
    return difference / standard_error;
}

/// Sets relmse_trimmed and trimmed_energy; reorders the pixels.
void trim(std::vector<PixelError>& pixels, Difference& result) {
    const size_t trimmed = pixels.size() / 1000;
    const auto first_kept = pixels.begin() + static_cast<std::ptrdiff_t>(trimmed);
    std::nth_element(pixels.begin(), first_kept, pixels.end(),
                     [](const PixelError& x, const PixelError& y) { return x.relative > y.relative; });
    double kept_error = 0.0, trimmed_energy = 0.0, kept_energy = 0.0;
    for (auto pixel = pixels.begin(); pixel != first_kept; ++pixel) {
        trimmed_energy += pixel->energy;
    }
    for (auto pixel = first_kept; pixel != pixels.end(); ++pixel) {
        kept_error += pixel->relative;
        kept_energy += pixel->energy;
    }
    const double energy = trimmed_energy + kept_energy;
    result.relmse_trimmed = kept_error / (3.0 * static_cast<double>(pixels.size() - trimmed));
    result.trimmed_energy = energy > 0.0 ? trimmed_energy / energy : 0.0;
}

void require_comparable(const LayeredImage& a, const LayeredImage& b) {
    const auto text = [](const Image& image) {
        return std::to_string(image.width) + "x" + std::to_string(image.height) + " with " +
               std::to_string(image.channels) + " channels";
    };
    if (!a.color.same_shape(b.color) || a.color.channels != 3) {
        throw Error("the pictures cannot be compared: " + text(a.color) + " against " + text(b.color));
    }
    for (const LayeredImage* picture : {&a, &b}) {
        if (picture->standard_error && !picture->standard_error->same_shape(picture->color)) {
            throw Error("the pictures cannot be compared: a standard error of " + text(*picture->standard_error) +
                        " beside colour of " + text(picture->color));
        }
    }
}

}  // namespace

Difference compare_images(const LayeredImage& a, const LayeredImage& b) {
    require_comparable(a, b);
    std::vector<PixelError> pixels;
    pixels.reserve(a.color.pixel_count());
    double squared = 0.0, relative = 0.0;
    std::array<double, 3> sum_a{}, sum_b{}, variance{};
    size_t equal = 0;
    const bool has_errors = a.standard_error && b.standard_error;

    for (size_t i = 0; i < a.color.data.size(); i += 3) {
        const float* rgb_a = &a.color.data[i];
        const float* rgb_b = &b.color.data[i];
        if (!all_finite(rgb_a) || !all_finite(rgb_b)) {
            continue;
        }
        PixelError pixel{0.0, 0.0};
        bool pixel_equal = true;
        for (size_t channel = 0; channel < 3; ++channel) {
            const double value_a = rgb_a[channel], value_b = rgb_b[channel];
            const double square = (value_a - value_b) * (value_a - value_b);
            squared += square;
            pixel.relative += square / (value_b * value_b + 1e-2);
            pixel.energy += std::abs(value_a);
            pixel_equal = pixel_equal && nearly_equal(value_a, value_b);
            sum_a[channel] += value_a;
            sum_b[channel] += value_b;
            if (!has_errors) {
                continue;
            }
            const double error_a = a.standard_error->data[i + channel], error_b = b.standard_error->data[i + channel];
            variance[channel] += error_a * error_a + error_b * error_b;
        }
        relative += pixel.relative;
        equal += pixel_equal ? 1 : 0;
        pixels.push_back(pixel);
    }

    Difference result{unknown,
                      unknown,
                      unknown,
                      unknown,
                      {unknown, unknown, unknown},
                      {unknown, unknown, unknown},
                      unknown,
                      a.color.pixel_count() - pixels.size()};
    if (pixels.empty()) {
        return result;
    }
    const double count = static_cast<double>(pixels.size());
    result.mse = squared / (3.0 * count);
    result.relmse = relative / (3.0 * count);
    result.fraction_equal = static_cast<double>(equal) / count;
    for (size_t channel = 0; channel < 3; ++channel) {
        result.mean_ratio[channel] = sum_a[channel] / sum_b[channel];
        if (has_errors) {
            result.z_mean[channel] =
                z_of(sum_a[channel] / count, sum_b[channel] / count, std::sqrt(variance[channel]) / count);
        }
    }
    trim(pixels, result);
    return result;
}

}  // namespace diptych::core
