// The CPU panel against the oracle, which shares no code with it: Welch's test of the image mean and of every tile. The
// samples of a side are independent, so a mean's error is theirs, and its degrees of freedom are so many that t is
// normal.
#include <algorithm>
#include <cstdio>

#include "oracle_renderer/oracle_renderer.h"
#include "panels_fixture.h"

using namespace diptych;
using namespace diptych::tests;

namespace {

constexpr int width = 32;
constexpr int height = 24;
constexpr int tile = 8;

Film render_oracle(const Scene& scene, const RenderSettings& settings, std::uint32_t spp) {
    const auto renderer = make_oracle_renderer(scene, settings, oracle::Mode::mis, 2);
    const std::atomic<bool> cancel{false};
    renderer->render(0, spp, cancel);
    return renderer->film();
}

ImageMean tile_mean(const Film& film, int left, int top) {
    Film part;
    part.width = tile;
    part.height = tile;
    for (int y = top; y < top + tile; ++y) {
        for (int x = left; x < left + tile; ++x) {
            const auto i = static_cast<std::size_t>(y * film.width + x);
            part.pixels.push_back(film.pixels[i]);
            part.moments.push_back(film.moments[i]);
        }
    }
    return image_mean(part);
}

struct Agreement {
    double image_z = 0;
    double tile_z = 0;            // of the worst tile
    double detectable_image = 0;  // relative bias of the mean that is found nine times in ten
    double detectable_tile = 0;   // median over the tiles
};

// Two-sided at 7e-6 for an image, and for the worst of its tiles and channels about 4e-5 in all.
constexpr double image_limit = 4.5;
constexpr double tile_limit = 5.5;
constexpr double nine_in_ten = 1.2816;

Agreement compare(const Film& cpu, const Film& oracle) {
    Agreement out;
    const ImageMean a = image_mean(cpu);
    const ImageMean b = image_mean(oracle);
    out.image_z = worst_z(a, b);
    out.detectable_image = (image_limit + nine_in_ten) * relative_error(a, b);
    std::vector<double> detectable;
    for (int y = 0; y < height; y += tile) {
        for (int x = 0; x < width; x += tile) {
            const ImageMean c = tile_mean(cpu, x, y);
            const ImageMean o = tile_mean(oracle, x, y);
            out.tile_z = std::max(out.tile_z, worst_z(c, o));
            detectable.push_back((tile_limit + nine_in_ten) * relative_error(c, o));
        }
    }
    std::sort(detectable.begin(), detectable.end());
    out.detectable_tile = detectable[detectable.size() / 2];
    return out;
}

/// `detectable`: the bias of the image mean that the test has to be able to find.
void check_against_oracle(const std::string& name, const Scene& scene, double detectable) {
    RenderSettings settings = statistical_settings(width, height, Integrator::path, 4);
    const Film cpu = render_cpu(scene, settings, 512);
    settings.seed = 77;
    const Film oracle = render_oracle(scene, settings, 1024);
    const Agreement a = compare(cpu, oracle);
    std::printf("%-30s z %.2f, worst tile %.2f; would find a bias of %.2f %% of the image, %.1f %% of a tile\n",
                name.c_str(), a.image_z, a.tile_z, 100 * a.detectable_image, 100 * a.detectable_tile);
    INFO(name << ": cpu " << describe(image_mean(cpu)) << "oracle " << describe(image_mean(oracle)) << "z " << a.image_z
              << " tile " << a.tile_z);
    CHECK(film_totals(cpu).nonfinite + film_totals(oracle).nonfinite == 0);
    CHECK(a.image_z < image_limit);
    CHECK(a.tile_z < tile_limit);
    CHECK(a.detectable_image < detectable);
}

}  // namespace

TEST_CASE("The CPU panel has the oracle's means") {
    check_against_oracle("cornell", load_own_scene("cornell"), 0.06);
    for (const auto& [name, scene] : agreement_scenes()) {
        if (name == "unlit screen and a spot light" || name == "mirrored instances of a light" ||
            name == "normal-mapped gloss") {
            check_against_oracle(name, scene, 0.06);
        }
    }
}
