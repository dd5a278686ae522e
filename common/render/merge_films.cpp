#include "render/merge_films.h"

#include "error.h"
#include "render/film_statistics.h"

namespace diptych::core {

namespace {

/// A double as a pair of floats, the film's own form.
void split(double value, float& high, float& low) {
    high = static_cast<float>(value);
    low = static_cast<float>(value - static_cast<double>(high));
}

double joined(float high, float low) {
    return static_cast<double>(high) + static_cast<double>(low);
}

void merge_moments(const shared::FilmPixel& from_pixel, const shared::FilmMoments& from,
                   const shared::FilmPixel& into_pixel, shared::FilmMoments& into) {
    if (from_pixel.samples == 0) {
        return;
    }
    if (into_pixel.samples == 0) {
        into = from;
        return;
    }
    const double n = from_pixel.samples;
    for (int c = 0; c < 3; ++c) {
        // Σ (x - f)² = Σ (x - g)² + 2 (g - f) Σ (x - g) + n (g - f)², f and g the first samples of both.
        const double shift = static_cast<double>(from.first[c]) - static_cast<double>(into.first[c]);
        const double deviations =
            joined(from_pixel.sum[c], from_pixel.compensation[c]) - n * static_cast<double>(from.first[c]);
        const double squares =
            joined(from.sum_squares[c], from.compensation[c]) + 2 * shift * deviations + n * shift * shift;
        split(joined(into.sum_squares[c], into.compensation[c]) + squares, into.sum_squares[c], into.compensation[c]);
    }
}

/// Means over all samples, dropped ones included.
void merge_first_hits(const shared::FilmPixel& from_pixel, const shared::FilmFirstHit& from,
                      const shared::FilmPixel& into_pixel, shared::FilmFirstHit& into) {
    const double n = static_cast<double>(from_pixel.samples) + from_pixel.nonfinite;
    const double m = static_cast<double>(into_pixel.samples) + into_pixel.nonfinite;
    if (n + m == 0) {
        return;
    }
    const auto mean = [&](float a, float b) {
        return static_cast<float>((n * static_cast<double>(a) + m * static_cast<double>(b)) / (n + m));
    };
    for (int c = 0; c < 3; ++c) {
        into.albedo[c] = mean(from.albedo[c], into.albedo[c]);
        into.normal[c] = mean(from.normal[c], into.normal[c]);
    }
    into.depth = mean(from.depth, into.depth);
}

void merge_pixel(const shared::FilmPixel& from, shared::FilmPixel& into) {
    for (int c = 0; c < 3; ++c) {
        split(joined(into.sum[c], into.compensation[c]) + joined(from.sum[c], from.compensation[c]), into.sum[c],
              into.compensation[c]);
    }
    into.samples += from.samples;
    into.nonfinite += from.nonfinite;
    const std::uint64_t rays = std::uint64_t{into.rays} + from.rays;
    into.rays = static_cast<std::uint32_t>(rays);
    into.ray_wraps += from.ray_wraps + static_cast<std::uint32_t>(rays >> 32U);
}

}  // namespace

void merge_films(const Film& from, Film& into) {
    if (from.width != into.width || from.height != into.height || from.moments.size() != into.moments.size() ||
        from.first_hits.size() != into.first_hits.size()) {
        throw Error("films of different sizes or layers cannot be merged");
    }
    for (std::size_t i = 0; i < into.pixels.size(); ++i) {
        if (!into.moments.empty()) {
            merge_moments(from.pixels[i], from.moments[i], into.pixels[i], into.moments[i]);
        }
        if (!into.first_hits.empty()) {
            merge_first_hits(from.pixels[i], from.first_hits[i], into.pixels[i], into.first_hits[i]);
        }
        merge_pixel(from.pixels[i], into.pixels[i]);
    }
}

}  // namespace diptych::core
