// How far a scene magnifies a rounding: the yardstick for paths that part between two panels.
#include <cmath>
#include <cstdio>

#include "measure/path_agreement.h"
#include "render_fixture.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

std::vector<shared::PathQuery> all_queries(const RenderSettings& settings, std::uint32_t spp) {
    std::vector<shared::PathQuery> queries;
    for (std::uint32_t y = 0; y < static_cast<std::uint32_t>(settings.height); ++y) {
        for (std::uint32_t x = 0; x < static_cast<std::uint32_t>(settings.width); ++x) {
            for (std::uint32_t s = 0; s < spp; ++s) {
                queries.push_back({{x, y}, s});
            }
        }
    }
    return queries;
}

/// The scene from a camera that stands one rounding of its own coordinates to the right.
Scene one_rounding_aside(Scene scene, int camera) {
    glm::dmat4& to_world = scene.cameras[static_cast<std::size_t>(camera)].camera_to_world;
    const auto largest =
        static_cast<float>(std::max({std::abs(to_world[3].x), std::abs(to_world[3].y), std::abs(to_world[3].z), 1.0}));
    to_world[3] += to_world[0] * static_cast<double>(std::nextafter(largest, INFINITY) - largest);
    return scene;
}

double most_parted(const PairedReport& report) {
    double most = 0;
    for (const PairedBounce& bounce : report.bounces) {
        most = std::max(most, static_cast<double>(bounce.parted) /
                                  static_cast<double>(std::max<std::uint64_t>(bounce.reached, 1)));
    }
    return most;
}

/// The CPU panel against itself, one rounding away.
PairedReport compare_with_itself(const std::string& name, const RenderSettings& settings, std::uint32_t spp) {
    const Scene scene = load_own_scene(name);
    const PackedScene here = pack_scene(scene, settings);
    const PackedScene aside = pack_scene(one_rounding_aside(scene, settings.camera), settings);
    const std::vector<shared::PathQuery> queries = all_queries(settings, spp);
    PairedTest test;
    test.add(queries, make_cpu_renderer(here, 0)->summarize_paths(queries),
             make_cpu_renderer(aside, 0)->summarize_paths(queries));
    PairedReport report = test.report();
    std::printf("%-14s %-6s %8llu paths, parted %llu (at most %.1e a bounce), drifted %llu, z %.2f %.2f %.2f\n",
                name.c_str(), name_of(settings.integrator), static_cast<unsigned long long>(report.paths),
                static_cast<unsigned long long>(report.paths - report.alike), most_parted(report),
                static_cast<unsigned long long>(report.drifted), report.divergent_z[0], report.divergent_z[1],
                report.divergent_z[2]);
    return report;
}

}  // namespace

TEST_CASE("Paths part from themselves a rounding away where a scene magnifies roundings", "[nightly]") {
    for (const std::string& name : own_scenes()) {
        for (const Integrator integrator : integrators) {
            RenderSettings settings = statistical_settings(128, 96, integrator, 5);
            const PairedReport report = compare_with_itself(name, settings, 32);
            INFO(name << " " << name_of(integrator));
            for (const double z : report.divergent_z) {
                CHECK(std::abs(z) < 4);
            }
            CHECK(report.nonfinite == 0);
        }
    }
}
