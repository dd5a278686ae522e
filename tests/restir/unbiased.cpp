// ReSTIR against `path`, frame by frame: early frames, later ones, and scenes whose lights and occluders change under
// the reservoirs.
#include "chain_cases.h"

namespace diptych::core::tests {

TEST_CASE("restir is unbiased at every frame, whatever its weights and wherever it puts visibility") {
    for (const ResamplingMis mis : {ResamplingMis::pairwise, ResamplingMis::balance, ResamplingMis::one_over_z}) {
        for (const ResamplingVisibility visibility : {ResamplingVisibility::shading, ResamplingVisibility::target}) {
            ChainCase c = chain_case("many lights", generated("many-lights", 300));
            c.settings.resampling.mis = mis;
            c.settings.resampling.visibility = visibility;
            // Weights that do not know how others would have picked a point leave fireflies: of 1/Z the width shows one
            // or none.
            ChainSize size;
            size.copies = mis == ResamplingMis::pairwise ? size.copies : 2 * size.copies;
            check_frames(c, {0, 1, 8}, 12, size);
        }
    }
}

TEST_CASE("restir is unbiased where neighbours see the lamp by turns") {
    for (const bool glossy : {false, true}) {
        ChainCase c = chain_case(glossy ? "glossy slats" : "slats", slats(glossy));
        ChainSize size;
        if (glossy) {
            c.settings.resampling.light_candidates = 1;  // so that the material's own candidate counts
            size.copies = 12;
        }
        check_frames(c, {0, 1, 8}, 6, size);
        c.settings.resampling.visibility = ResamplingVisibility::target;
        check_frames(c, {0, 1, 8}, 6, size);
    }
}

TEST_CASE("restir is unbiased in a box with one light, the rest of the path included") {
    ChainCase c = chain_case("cornell", generated("cornell"));
    c.settings.max_depth = 3;
    check_frames(c, {0, 1, 2, 8}, 2);
    c.settings.resampling.spatial_passes = 2;
    check_frames(c, {0, 1, 2, 8}, 2);
}

TEST_CASE("restir is unbiased where lights switch and move, and an occluder with them") {
    // The lamp switches on at 1 s, another off at 2 s (scenes/README.md).
    ChainCase c = chain_case("moving light", generated("moving-light"));
    c.seconds = 0.125;
    c.start = 0.5;
    check_frames(c, {0, 1, 3, 4, 5, 11, 12, 13}, 4);
    c.settings.resampling.visibility = ResamplingVisibility::target;
    check_frames(c, {0, 1, 4, 12}, 4);
}

TEST_CASE("restir is unbiased where glossy surfaces look for lights that switch and move") {
    ChainCase c = chain_case("moving light, glossy", generated("moving-light"));
    for (Material& material : c.scene.materials) {
        material.metallic = 1;
        material.roughness = 0.3F;
    }
    c.seconds = 0.125;
    c.start = 0.5;
    check_frames(c, {0, 1, 3, 4, 5, 12, 13}, 5, {16, 24});
}

TEST_CASE("restir is unbiased under a moving camera") {
    ChainCase c = chain_case("orbit", generated("cornell"));
    c.orbit = 3;
    check_frames(c, {0, 1, 4, 8}, 1.5);
}

TEST_CASE("ris is unbiased on glossy surfaces, where material sampling finds the light too") {
    for (const Integrator integrator : {Integrator::ris, Integrator::restir}) {
        ChainCase c = chain_case("veach", generated("veach-mis"));
        c.settings.integrator = integrator;
        // The smoothest plate shows the smallest lamp within a part of one pixel, which few camera rays meet.
        check_frames(c, {0, 3}, 15, {16, 16});
    }
}

TEST_CASE(
    "A bulb close by is found by its solid angle or its distance, without bias and with less noise than by power") {
    ChainCase c = chain_case("bulb close by", bulb_close_by());
    check_frames(c, {8}, 7, {16, 24});
    c.settings.integrator = Integrator::ris;
    check_frames(c, {0}, 7, {16, 24});

    const auto spread = [&](bool by_material, float near_share) {
        c.settings.resampling.bsdf_candidate = by_material;
        c.settings.resampling.near_share = near_share;
        const std::vector<double> means = run_chains(c, {}, {0}, on_cpu, 3)[0];
        return difference(means, means).half_width;
    };
    const double by_power = spread(false, 0);
    const double by_material = spread(true, 0);
    const double by_distance = spread(false, 0.5F);
    std::printf("bulb close by, ris: +- %.2f %%, by material sampling %.2f %%, by distance %.2f %%\n", by_power,
                by_material, by_distance);
    CHECK(by_material < 0.5 * by_power);
    CHECK(by_distance < 0.5 * by_power);
}

TEST_CASE("A lamp within reach is shared with its solid angle, one beyond is left to its power") {
    for (const float height : {0.4F, 0.55F}) {
        ChainCase c = chain_case("lamp overhead", lamp_overhead(height));
        c.settings.integrator = Integrator::ris;
        c.settings.resampling.light_candidates = 1;  // of one lamp the reach is its side
        check_frames(c, {0}, 0.5, {16, 32});
    }
}

TEST_CASE("restir is unbiased through a sheet that half of the light passes, wherever it puts visibility") {
    for (const bool glossy : {false, true}) {
        for (const ResamplingVisibility visibility : {ResamplingVisibility::shading, ResamplingVisibility::target}) {
            ChainCase c = chain_case(glossy ? "sheet, glossy" : "sheet", sheet(glossy));
            c.settings.resampling.visibility = visibility;
            c.settings.resampling.light_candidates = 1;
            check_frames(c, {0, 2}, 6, {16, 12});
        }
        // Sampling the material finds no such emitter, but what is behind it.
        ChainCase c = chain_case(glossy ? "glowing sheet, glossy" : "glowing sheet", sheet(glossy));
        c.scene.materials.back().emission = glm::vec3(2);
        c.settings.resampling.light_candidates = 1;
        check_frames(c, {0, 2}, 6, {16, 12});
    }
}

TEST_CASE("restir is unbiased where emitters hide a lamp from neighbours by turns") {
    ChainCase c = chain_case("glowing slats", slats(true, 0.001F));
    c.settings.resampling.light_candidates = 1;
    check_frames(c, {0, 1, 8}, 6, {16, 24});
}

TEST_CASE("ris and restir are unbiased under a sky alone, whatever features are allowed") {
    for (const Integrator integrator : {Integrator::ris, Integrator::restir}) {
        for (const bool generic : {false, true}) {
            ChainCase c = chain_case(generic ? "sky, generic" : "sky", under_sky());
            c.settings.integrator = integrator;
            c.settings.generic = generic;
            check_frames(c, {0, 1}, 2, {16, 4});
        }
    }
}

TEST_CASE("Spatial passes draw apart") {
    ChainCase c = chain_case("hidden lamp", hidden_lamp());
    c.settings.resampling.light_candidates = 1;
    c.settings.resampling.bsdf_candidate = false;
    c.settings.resampling.temporal = false;
    c.settings.resampling.spatial_passes = 4;
    c.settings.resampling.neighbors = 1;
    c.settings.resampling.radius = 3;
    check_frames(c, {0, 4}, 4, {16, 16});
}

TEST_CASE("Frames draw apart") {
    ChainCase c = chain_case("hidden lamp", hidden_lamp());
    c.settings.resampling.light_candidates = 1;
    c.settings.resampling.bsdf_candidate = false;
    c.settings.resampling.neighbors = 1;
    c.settings.resampling.radius = 3;
    check_frames(c, {0, 4, 8}, 4, {16, 16});
}

TEST_CASE("MIS between lights and material is unbiased where much is hidden", "[nightly]") {
    ChainCase c = chain_case("glossy slats", slats(true));
    c.settings.resampling.light_candidates = 1;
    check_frames(c, {8, 16}, 1.5, {16, 48});
}

TEST_CASE("Long chains of restir stay unbiased", "[nightly]") {
    const ChainSize many{16, 48};
    check_frames(chain_case("many lights", generated("many-lights", 300)), chain_frames, 3, many);
    ChainCase box = chain_case("cornell", generated("cornell"));
    box.settings.max_depth = 3;
    check_frames(box, chain_frames, 0.5, many);
    ChainCase moving = chain_case("moving light", generated("moving-light"));
    moving.seconds = 1.0 / 24;
    check_frames(moving, chain_frames, 1, {16, 56});
    check_frames(chain_case("veach", generated("veach-mis")), chain_frames, 5, many);
}

TEST_CASE("Long chains of restir stay unbiased whichever one thing moves", "[nightly]") {
    for (const ChainCase& c : moving_cases()) {
        check_frames(c, chain_frames, 2, {16, 32});
    }
}

TEST_CASE("The biased weights and shortcuts are what their names say") {
    // A lamp has just been switched on, so that reservoirs from before it could not hold its light.
    ChainCase c = chain_case("moving light", generated("moving-light"));
    c.seconds = 0.125;
    c.start = 0.5;
    c.settings.resampling.mis = ResamplingMis::biased_one_over_m;
    const Difference one_over_m =
        difference(run_chains(c, {}, {5}, on_cpu, 17)[0], run_reference(c, {}, 5, 16, 64, on_cpu));
    INFO("1/M: " << one_over_m.percent << " % +- " << one_over_m.half_width);
    CHECK(one_over_m.z < -4.5);

    ChainCase striped = chain_case("slats", slats(false));
    const std::vector<double> truth = run_reference(striped, {}, 8, 32, 128, on_cpu);
    for (const ResamplingVisibility shortcut :
         {ResamplingVisibility::biased_initial, ResamplingVisibility::biased_final}) {
        striped.settings.resampling.visibility = shortcut;
        const Difference loss = difference(run_chains(striped, {}, {8}, on_cpu, 17)[0], truth);
        INFO(name_of(shortcut) << ": " << loss.percent << " % +- " << loss.half_width);
        CHECK(loss.z < -4.5);
    }
}

}  // namespace diptych::core::tests
