#include "render/film_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "threads.h"

namespace diptych::core {

namespace {

constexpr double digit = 0x1p32;

/// A number as an unevaluated sum of two doubles, to 106 bits (Dekker 1971).
struct DoubleDouble {
    double high = 0;
    double low = 0;
};

DoubleDouble sum_of(double a, double b) {
    const double sum = a + b;
    const double from_b = sum - a;
    return {sum, (a - (sum - from_b)) + (b - from_b)};
}

DoubleDouble sum_of(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble high = sum_of(a.high, b.high);
    return sum_of(high.high, high.low + a.low + b.low);
}

DoubleDouble product_of(const DoubleDouble& a, const DoubleDouble& b) {
    const double high = a.high * b.high;
    return sum_of(high, std::fma(a.high, b.high, -high) + (a.high * b.low + a.low * b.high));
}

/// Of three bins of one channel, in units of the lowest.
DoubleDouble bins_value(const glm::uvec3 (&low)[3], const glm::uvec3 (&high)[3], int channel) {
    // Words of neighbouring bins have the same weight; each of these sums is exact.
    const double words[4] = {static_cast<double>(low[0][channel]),
                             static_cast<double>(low[1][channel]) + high[0][channel],
                             static_cast<double>(low[2][channel]) + high[1][channel],
                             static_cast<double>(high[2][channel])};
    const DoubleDouble upper = sum_of(words[3] * (digit * digit * digit), words[2] * (digit * digit));
    return sum_of(upper, sum_of(words[1] * digit, words[0]));
}

double scale_of(shared::uint base, int lowest) {
    return std::ldexp(1.0, 32 * static_cast<int>(base) + lowest);
}

DoubleDouble scaled(const DoubleDouble& x, double scale) {
    return {x.high * scale, x.low * scale};
}

}  // namespace

Rgb rounded(const shared::ExactSum& sum) {
    const double scale = scale_of(sum.base, -149);
    Rgb value;
    for (int c = 0; c < 3; ++c) {
        value[c] = bins_value(sum.low, sum.high, c).high * scale;
    }
    return value;
}

Rgb rounded(const shared::FixedSum& sum) {
    Rgb value;
    for (int c = 0; c < 3; ++c) {
        const std::uint64_t word = (std::uint64_t{sum.high[c]} << 32U) | sum.low[c];
        value[c] = static_cast<double>(static_cast<std::int64_t>(word)) * 0x1p-28;
    }
    return value;
}

double rounded(const shared::ExactScalar& sum) {
    const double middle = static_cast<double>(sum.low.y) + sum.high.x;
    return (sum.high.y * digit * digit + middle * digit + sum.low.x) * scale_of(sum.base, -149);
}

Rgb pixel_mean(const shared::FilmPixel& pixel) {
    Rgb mean{};
    if (pixel.samples > 0) {
        mean = rounded(pixel.sum);
        for (double& channel : mean) {
            channel /= pixel.samples;
        }
    }
    return mean;
}

MeanFirstHit mean_first_hit(const shared::FilmPixel& pixel, const shared::FilmFirstHit& hit) {
    const double n = std::max(1.0, static_cast<double>(pixel.samples) + pixel.nonfinite);
    MeanFirstHit means{rounded(hit.albedo), rounded(hit.normal), rounded(hit.depth) / n};
    for (std::size_t c = 0; c < 3; ++c) {
        means.albedo[c] /= n;
        means.normal[c] /= n;
    }
    return means;
}

Rgb pixel_standard_error(const shared::FilmPixel& pixel, const shared::FilmMoments& moments) {
    Rgb error;
    error.fill(std::numeric_limits<double>::quiet_NaN());
    if (pixel.samples < 2) {
        return error;
    }
    const double n = pixel.samples;
    const double sum_scale = scale_of(pixel.sum.base, -149);
    const double square_scale = scale_of(moments.squares.base, -298);
    for (int c = 0; c < 3; ++c) {
        const DoubleDouble sum = scaled(bins_value(pixel.sum.low, pixel.sum.high, c), sum_scale);
        const DoubleDouble squares = scaled(bins_value(moments.squares.low, moments.squares.high, c), square_scale);
        // n^2 times the variance is n sum(x^2) - sum(x)^2, which may cancel.
        const DoubleDouble difference = sum_of(product_of({n, 0}, squares), scaled(product_of(sum, sum), -1));
        error[c] = std::sqrt(std::max(0.0, difference.high + difference.low) / (n - 1)) / n;
    }
    return error;
}

std::optional<double> estimated_relmse(const Film& film) {
    struct Part {
        double sum = 0;
        std::size_t count = 0;
    };
    // Parts of a fixed size, added in order: a render stops by this number, which may not depend on how many cores there
    // are.
    constexpr std::size_t part_pixels = std::size_t{1} << 16U;
    std::vector<Part> parts((film.moments.size() + part_pixels - 1) / part_pixels);
    in_parts(parts.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin * part_pixels; i < std::min(end * part_pixels, film.moments.size()); ++i) {
            Part& part = parts[i / part_pixels];
            const Rgb error = pixel_standard_error(film.pixels[i], film.moments[i]);
            const Rgb mean = pixel_mean(film.pixels[i]);
            for (int channel = 0; channel < 3; ++channel) {
                if (std::isfinite(error[channel])) {
                    part.sum += error[channel] * error[channel] / (mean[channel] * mean[channel] + 1e-2);
                    ++part.count;
                }
            }
        }
    });
    Part all;
    for (const Part& part : parts) {
        all.sum += part.sum;
        all.count += part.count;
    }
    return all.count == 0 ? std::nullopt : std::optional(all.sum / static_cast<double>(all.count));
}

}  // namespace diptych::core
