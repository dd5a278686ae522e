#include "render/film.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/film_statistics.h"

namespace diptych::core {

namespace {

constexpr int channels = 3;

void store(Image& image, std::size_t pixel, const Rgb& value) {
    for (int channel = 0; channel < channels; ++channel) {
        image.data[pixel * channels + channel] = static_cast<float>(value[channel]);
    }
}

void develop_first_hits(const Film& film, LayeredImage& layers) {
    layers.albedo = make_image(film.width, film.height, channels);
    layers.normal = make_image(film.width, film.height, channels);
    layers.depth = make_image(film.width, film.height, 1);
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        const shared::FilmFirstHit& hit = film.first_hits[i];
        store(*layers.albedo, i, {hit.albedo.x, hit.albedo.y, hit.albedo.z});
        store(*layers.normal, i, {hit.normal.x, hit.normal.y, hit.normal.z});
        layers.depth->data[i] = hit.depth;
    }
}

}  // namespace

FilmTotals film_totals(const Film& film) {
    FilmTotals totals;
    for (const shared::FilmPixel& pixel : film.pixels) {
        totals.samples += pixel.samples;
        totals.nonfinite += pixel.nonfinite;
        totals.rays += (std::uint64_t{pixel.ray_wraps} << 32U) + pixel.rays;
    }
    return totals;
}

Rgb pixel_mean(const shared::FilmPixel& pixel) {
    Rgb mean{};
    if (pixel.samples == 0) {
        return mean;
    }
    for (int channel = 0; channel < channels; ++channel) {
        const double sum = static_cast<double>(pixel.sum[channel]) + pixel.compensation[channel];
        mean[channel] = sum / pixel.samples;
    }
    return mean;
}

Rgb pixel_standard_error(const shared::FilmPixel& pixel, const shared::FilmMoments& moments) {
    Rgb error;
    error.fill(std::numeric_limits<double>::quiet_NaN());
    if (pixel.samples < 2) {
        return error;
    }
    const double n = pixel.samples;
    const Rgb mean = pixel_mean(pixel);
    for (int channel = 0; channel < channels; ++channel) {
        const double squares = static_cast<double>(moments.sum_squares[channel]) + moments.compensation[channel];
        const double shift = mean[channel] - moments.first[channel];
        const double variance = std::max(0.0, squares - n * shift * shift) / (n - 1);
        error[channel] = std::sqrt(variance / n);
    }
    return error;
}

std::optional<double> estimated_relmse(const Film& film) {
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < film.moments.size(); ++i) {
        const Rgb error = pixel_standard_error(film.pixels[i], film.moments[i]);
        const Rgb mean = pixel_mean(film.pixels[i]);
        for (int channel = 0; channel < channels; ++channel) {
            if (std::isfinite(error[channel])) {
                sum += error[channel] * error[channel] / (mean[channel] * mean[channel] + 1e-2);
                ++count;
            }
        }
    }
    return count == 0 ? std::nullopt : std::optional(sum / static_cast<double>(count));
}

LayeredImage develop(const Film& film) {
    LayeredImage layers;
    layers.color = make_image(film.width, film.height, channels);
    if (!film.moments.empty()) {
        layers.standard_error = make_image(film.width, film.height, channels);
    }
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        store(layers.color, i, pixel_mean(film.pixels[i]));
        if (layers.standard_error) {
            store(*layers.standard_error, i, pixel_standard_error(film.pixels[i], film.moments[i]));
        }
    }
    if (!film.first_hits.empty()) {
        develop_first_hits(film, layers);
    }
    return layers;
}

}  // namespace diptych::core
