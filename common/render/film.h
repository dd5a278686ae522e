// A backend's film on the host, and the images it becomes.
#pragma once

#include <cstdint>
#include <vector>

#include "film/film_pixel.h"
#include "image/layered_image.h"

namespace diptych::core {

/// Row-major from the top. `moments` and `first_hits` are empty where their layer was not asked for.
struct Film {
    int width = 0;
    int height = 0;
    std::vector<shared::FilmPixel> pixels;
    std::vector<shared::FilmMoments> moments;
    std::vector<shared::FilmFirstHit> first_hits;
};

/// Bytes of a film of so many pixels with these layers.
std::uint64_t film_bytes(std::uint64_t pixels, bool moments, bool first_hits);

struct FilmTotals {
    std::uint64_t samples = 0;    // averaged, over all pixels
    std::uint64_t nonfinite = 0;  // dropped
    std::uint64_t rays = 0;
    // Samples of the pixel that has the fewest, and of the one that has most, dropped ones included.
    std::uint32_t least = 0;
    std::uint32_t most = 0;
};

FilmTotals film_totals(const Film& film);

/// How many samples every pixel has, dropped ones included.
std::uint32_t samples_of_every_pixel(const Film& film);

enum class FilmLayers { color, all };

/// Means, standard errors of the means, first-hit means; double inside. A pixel without samples is black.
LayeredImage develop(const Film& film, FilmLayers layers = FilmLayers::all);

/// The same of rows first .. first+count-1 alone.
LayeredImage develop_rows(const Film& film, int first, int count, FilmLayers layers = FilmLayers::all);

}  // namespace diptych::core
