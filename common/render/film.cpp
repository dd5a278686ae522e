#include "render/film.h"

#include <algorithm>
#include <limits>
#include <mutex>

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

/// From pixel `first` of the film on.
void develop_first_hits(const Film& film, std::size_t first, LayeredImage& layers) {
    layers.albedo = make_image(layers.color.width, layers.color.height, channels);
    layers.normal = make_image(layers.color.width, layers.color.height, channels);
    layers.depth = make_image(layers.color.width, layers.color.height, 1);
    in_parts(layers.color.pixel_count(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const MeanFirstHit means = mean_first_hit(film.pixels[first + i], film.first_hits[first + i]);
            store(*layers.albedo, i, means.albedo);
            store(*layers.normal, i, means.normal);
            layers.depth->data[i] = static_cast<float>(means.depth);
        }
    });
}

}  // namespace

std::uint64_t film_bytes(std::uint64_t pixels, bool moments, bool first_hits) {
    return pixels * (sizeof(shared::FilmPixel) + (moments ? sizeof(shared::FilmMoments) : 0) +
                     (first_hits ? sizeof(shared::FilmFirstHit) : 0));
}

FilmTotals film_totals(const Film& film) {
    FilmTotals totals;
    totals.least = film.pixels.empty() ? 0 : std::numeric_limits<std::uint32_t>::max();
    std::mutex mutex;
    in_parts(film.pixels.size(), [&](std::size_t begin, std::size_t end) {
        FilmTotals part = {.least = std::numeric_limits<std::uint32_t>::max()};
        for (std::size_t i = begin; i < end; ++i) {
            const shared::FilmPixel& pixel = film.pixels[i];
            part.samples += pixel.samples;
            part.nonfinite += pixel.nonfinite;
            part.rays += (std::uint64_t{pixel.ray_wraps} << 32U) + pixel.rays;
            part.least = std::min(part.least, pixel.samples + pixel.nonfinite);
            part.most = std::max(part.most, pixel.samples + pixel.nonfinite);
        }
        const std::lock_guard lock(mutex);
        totals.samples += part.samples;
        totals.nonfinite += part.nonfinite;
        totals.rays += part.rays;
        totals.least = std::min(totals.least, part.least);
        totals.most = std::max(totals.most, part.most);
    });
    return totals;
}

std::uint32_t samples_of_every_pixel(const Film& film) {
    return film_totals(film).least;
}

LayeredImage develop(const Film& film, FilmLayers layers) {
    return develop_rows(film, 0, film.height, layers);
}

LayeredImage develop_rows(const Film& film, int first_row, int count, FilmLayers wanted) {
    const std::size_t first = static_cast<std::size_t>(first_row) * static_cast<std::size_t>(film.width);
    LayeredImage layers;
    layers.color = make_image(film.width, count, channels);
    if (wanted == FilmLayers::all && !film.moments.empty()) {
        layers.standard_error = make_image(film.width, count, channels);
    }
    in_parts(layers.color.pixel_count(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            store(layers.color, i, pixel_mean(film.pixels[first + i]));
            if (layers.standard_error) {
                store(*layers.standard_error, i, pixel_standard_error(film.pixels[first + i], film.moments[first + i]));
            }
        }
    });
    if (wanted == FilmLayers::all && !film.first_hits.empty()) {
        develop_first_hits(film, first, layers);
    }
    return layers;
}

}  // namespace diptych::core
