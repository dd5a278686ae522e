#include "render/film.h"

#include <algorithm>
#include <limits>

#include "render/film_statistics.h"
#include "threads.h"

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
    in_parts(film.pixels.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const MeanFirstHit means = mean_first_hit(film.pixels[i], film.first_hits[i]);
            store(*layers.albedo, i, means.albedo);
            store(*layers.normal, i, means.normal);
            layers.depth->data[i] = static_cast<float>(means.depth);
        }
    });
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

std::uint32_t samples_of_every_pixel(const Film& film) {
    std::uint32_t least = film.pixels.empty() ? 0 : std::numeric_limits<std::uint32_t>::max();
    for (const shared::FilmPixel& pixel : film.pixels) {
        least = std::min(least, pixel.samples + pixel.nonfinite);
    }
    return least;
}

LayeredImage develop(const Film& film) {
    LayeredImage layers;
    layers.color = make_image(film.width, film.height, channels);
    if (!film.moments.empty()) {
        layers.standard_error = make_image(film.width, film.height, channels);
    }
    in_parts(film.pixels.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            store(layers.color, i, pixel_mean(film.pixels[i]));
            if (layers.standard_error) {
                store(*layers.standard_error, i, pixel_standard_error(film.pixels[i], film.moments[i]));
            }
        }
    });
    if (!film.first_hits.empty()) {
        develop_first_hits(film, layers);
    }
    return layers;
}

}  // namespace diptych::core
