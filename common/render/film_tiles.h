// A film as the means of its tiles, for tests of bias.
#pragma once

#include "render/film.h"
#include "stats/bias_test.h"

namespace diptych::core {

struct TileGrid {
    int columns = 0;
    int rows = 0;
};

/// Tiles of `tile` x `tile` pixels; the last column and row may be smaller.
TileGrid tile_grid(int width, int height, int tile);

/// The mean radiance of the image and of its tiles, row-major from the top; every pixel counts alike. A pixel without
/// samples is black.
RunMeans tile_means(const Film& film, int tile);

/// Adds the film of `samples` more samples a pixel to a run that has `done` of them.
void add_to_run(const Film& film, int tile, std::uint32_t done, std::uint32_t samples, RunMeans& run);

/// The means of two films of one run over different samples, `samples_a` and `samples_b` of each pixel.
RunMeans merge_means(const RunMeans& a, double samples_a, const RunMeans& b, double samples_b);

}  // namespace diptych::core
