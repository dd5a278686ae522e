// The test of bias on real renders that have none: one renderer against itself, with other seeds.
#include <algorithm>
#include <cstdio>

#include "render/film_tiles.h"
#include "render_fixture.h"
#include "stats/bias_verdict.h"
#include "stats/kolmogorov_smirnov.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

struct Setting {
    int size;
    int tile;
    std::uint32_t runs;
    std::uint32_t spp;
    int repeats;
};

void check_calibration(const std::string& name, Integrator integrator, const Setting& setting) {
    const Scene scene = load_own_scene(name);
    RenderSettings settings;
    settings.width = setting.size;
    settings.height = setting.size;
    settings.integrator = integrator;
    settings.max_depth = 4;
    const PackedScene packed = pack_scene(scene, settings);
    const auto renderer = make_cpu_renderer(packed, 0);
    const std::atomic<bool> cancel{false};
    std::uint32_t seed = 1;
    const auto render_side = [&] {
        std::vector<RunMeans> runs;
        for (std::uint32_t run = 0; run < setting.runs; ++run) {
            renderer->restart(seed++);
            renderer->render(0, setting.spp, cancel);
            runs.push_back(tile_means(renderer->film(), setting.tile));
        }
        return runs;
    };
    std::vector<double> tiles;
    std::vector<double> images;
    std::vector<double> fishers;
    std::vector<double> adjusted;
    for (int i = 0; i < setting.repeats; ++i) {
        const std::vector<RunMeans> a = render_side();
        const std::vector<RunMeans> b = render_side();
        const TileComparison comparison = compare_runs(a, b, {.resamplings = 100});
        CHECK(comparison.unequal == 0);
        images.push_back(comparison.global_p);
        fishers.push_back(comparison.fisher_p);
        adjusted.push_back(judge(std::span(&comparison, 1), {}).front().adjusted_p);
        for (const TileOutcome& tile : comparison.tiles) {
            if (tile.state == ChannelState::tested) {
                tiles.push_back(tile.p);
            }
        }
    }
    const auto failures = [&](double alpha) {
        return static_cast<double>(
            std::count_if(adjusted.begin(), adjusted.end(), [&](double p) { return p <= alpha; }));
    };
    const double n = setting.repeats;
    std::printf("%s %s: %d A/A tests of %u runs a side: failed %.0f at 0.1 (expected %.1f), %.0f at 0.01 (%.1f), %.0f "
                "at 0.001; "
                "KS of %zu tiles D %.4f p %.2g, Fisher p %.2g, image p %.2g\n",
                name.c_str(), name_of(integrator), setting.repeats, setting.runs, failures(0.1), 0.1 * n,
                failures(0.01), 0.01 * n, failures(0.001), tiles.size(), kolmogorov_smirnov_uniform(tiles).distance,
                kolmogorov_smirnov_uniform(tiles).p, kolmogorov_smirnov_uniform(fishers).p,
                kolmogorov_smirnov_uniform(images).p);
    std::fflush(stdout);
    for (const double alpha : {0.1, 0.01, 0.001}) {
        CAPTURE(alpha);
        CHECK(failures(alpha) <= n * alpha + 3.5 * std::sqrt(n * alpha * (1 - alpha)));
    }
    CHECK(kolmogorov_smirnov_uniform(tiles).p > 1e-3);
    CHECK(kolmogorov_smirnov_uniform(images).p > 1e-3);
    CHECK(kolmogorov_smirnov_uniform(fishers).p > 1e-3);
}

}  // namespace

TEST_CASE("Renders of one scene on one panel pass the test of bias as often as they should") {
    check_calibration("cornell", Integrator::path, {16, 8, 16, 16, 60});
}

TEST_CASE("Many renders of cornell on one panel pass the test of bias as often as they should", "[nightly]") {
    for (const Integrator integrator : integrators) {
        check_calibration("cornell", integrator, {32, 8, 32, 32, 200});
    }
}

TEST_CASE("Many renders of veach-mis on one panel pass the test of bias as often as they should", "[nightly]") {
    for (const Integrator integrator : integrators) {
        check_calibration("veach-mis", integrator, {32, 8, 32, 32, 200});
    }
}
