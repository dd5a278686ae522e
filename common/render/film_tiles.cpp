#include "render/film_tiles.h"

#include "render/film_statistics.h"

namespace diptych::core {

namespace {

void add(Channels& sum, const Channels& value, double factor) {
    for (std::size_t c = 0; c < 3; ++c) {
        sum[c] += factor * value[c];
    }
}

Channels merged(const Channels& a, double weight_a, const Channels& b, double weight_b) {
    Channels result{};
    add(result, a, weight_a);
    add(result, b, weight_b);
    return result;
}

}  // namespace

TileGrid tile_grid(int width, int height, int tile) {
    return {(width + tile - 1) / tile, (height + tile - 1) / tile};
}

RunMeans tile_means(const Film& film, int tile) {
    const TileGrid grid = tile_grid(film.width, film.height, tile);
    const std::size_t columns = static_cast<std::size_t>(grid.columns);
    RunMeans means;
    means.tiles.resize(columns * static_cast<std::size_t>(grid.rows));
    std::vector<double> pixels(means.tiles.size());
    for (int y = 0; y < film.height; ++y) {
        for (int x = 0; x < film.width; ++x) {
            const std::size_t at = static_cast<std::size_t>(y / tile) * columns + static_cast<std::size_t>(x / tile);
            const std::size_t pixel =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(film.width) + static_cast<std::size_t>(x);
            add(means.tiles[at], pixel_mean(film.pixels[pixel]), 1);
            pixels[at] += 1;
        }
    }
    for (std::size_t i = 0; i < means.tiles.size(); ++i) {
        add(means.image, means.tiles[i], 1 / static_cast<double>(film.pixels.size()));
        for (double& channel : means.tiles[i]) {
            channel /= pixels[i];
        }
    }
    return means;
}

RunMeans merge_means(const RunMeans& a, double samples_a, const RunMeans& b, double samples_b) {
    const double weight_a = samples_a / (samples_a + samples_b);
    const double weight_b = samples_b / (samples_a + samples_b);
    RunMeans result;
    result.image = merged(a.image, weight_a, b.image, weight_b);
    for (std::size_t i = 0; i < a.tiles.size(); ++i) {
        result.tiles.push_back(merged(a.tiles[i], weight_a, b.tiles[i], weight_b));
    }
    return result;
}

void add_to_run(const Film& film, int tile, std::uint32_t done, std::uint32_t samples, RunMeans& run) {
    const RunMeans means = tile_means(film, tile);
    run = done == 0 ? means : merge_means(run, done, means, samples);
}

}  // namespace diptych::core
