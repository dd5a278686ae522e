#include "oracle_means.h"

#include "oracle_renderer/oracle_renderer.h"

namespace diptych::core::tests {

RenderSettings oracle_settings(std::uint32_t max_depth) {
    return statistical_settings(oracle_columns * oracle_tile, oracle_rows * oracle_tile, Integrator::path, max_depth);
}

OraclePair render_with_oracle(const Scene& scene, RenderSettings settings, std::uint32_t spp) {
    OraclePair pair;
    pair.cpu = render_cpu(scene, settings, spp);
    settings.seed = 77;
    const auto oracle = make_oracle_renderer(scene, settings, oracle::Mode::mis, 2);
    const std::atomic<bool> cancel{false};
    oracle->render(0, 2 * spp, cancel);
    pair.oracle = oracle->film();
    CHECK(film_totals(pair.cpu).nonfinite + film_totals(pair.oracle).nonfinite == 0);
    return pair;
}

ImageMean tile_mean(const Film& film, int column, int row) {
    Film part;
    part.width = oracle_tile;
    part.height = oracle_tile;
    for (int y = row * oracle_tile; y < (row + 1) * oracle_tile; ++y) {
        for (int x = column * oracle_tile; x < (column + 1) * oracle_tile; ++x) {
            const auto i = static_cast<std::size_t>(y * film.width + x);
            part.pixels.push_back(film.pixels[i]);
            part.moments.push_back(film.moments[i]);
        }
    }
    return image_mean(part);
}

double detectable_bias(const ImageMean& a, const ImageMean& b, double limit) {
    constexpr double nine_in_ten = 1.2816;
    return (limit + nine_in_ten) * relative_error(a, b);
}

}  // namespace diptych::core::tests
