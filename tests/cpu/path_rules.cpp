// Small rules that paths keep, value by value: when roulette begins, and that no two rays of a path share a random decision.
#include <set>

#include "agreement_scenes.h"
#include "test_kernel.h"
#include "render_fixture.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

struct PaneFixture {
    Scene scene;
    PackedScene packed;
    EmbreeScene embree;
    Kernel kernel;

    PaneFixture() : scene(with_pane()), packed(pack_scene(scene, settings())), embree(packed), kernel{packed, packed.constants, {{embree}}} {}

    static Scene with_pane() {
        Scene scene;
        Material pane = diffuse_material(0.5F);
        pane.alpha_mode = AlphaMode::blend;
        pane.base_color.a = 0.5F;
        add_object(scene, "pane", {horizontal_square({0, 0, 0}, 1, true, add_material(scene, pane))});
        scene.cameras.push_back(point_camera({0, 1, 1}, {0, 0, 0}));
        return scene;
    }
    static RenderSettings settings() { return statistical_settings(4, 4, Integrator::path, 16); }
};

}  // namespace

TEST_CASE("Roulette begins at the third vertex, goes by the largest channel, and kills with 5 % at least") {
    PaneFixture f;
    for (shared::uint depth = 0; depth < 3; ++depth) {
        CHECK(f.kernel.survival_probability({0.01F, 0.02F, 0.03F}, depth) == 1.0F);
    }
    for (shared::uint depth = 3; depth < 20; ++depth) {
        CHECK(f.kernel.survival_probability({0.1F, 0.6F, 0.2F}, depth) == 0.6F);
        CHECK(f.kernel.survival_probability({0.1F, 0.2F, 0.4F}, depth) == 0.4F);
        CHECK(f.kernel.survival_probability({3.0F, 0.2F, 0.2F}, depth) == 0.95F);
    }
}

TEST_CASE("No two rays of a path decide about alpha by the same number, nor do two paths") {
    PaneFixture f;
    REQUIRE(f.kernel.feature(shared::FEATURE_ALPHA));
    std::set<std::uint32_t> keys;
    std::size_t rays = 0;
    for (std::uint32_t sample = 0; sample < 8; ++sample) {
        for (std::uint32_t pixel = 0; pixel < 16; ++pixel) {
            auto path = f.kernel.begin_path({pixel % 4, pixel / 4}, sample);
            for (path.depth = 0; path.depth <= 16; ++path.depth) {
                keys.insert(f.kernel.next_ray_key(path));
                rays += 1;
                if (path.depth > 0) {
                    keys.insert(f.kernel.shadow_ray_key(path));
                    rays += 1;
                }
            }
        }
    }
    CHECK(keys.size() + 1 >= rays);  // of 4224 numbers of 31 bits two are equal by chance with probability 0.4 %
    CHECK(keys.count(shared::NONE) == 0);
}

TEST_CASE("A sample that is dropped leaves neither mean nor second moment touched, be it the first") {
    PaneFixture f;
    REQUIRE(f.kernel.feature(shared::FEATURE_STANDARD_ERROR));
    const float bad = std::nanf("");
    shared::FilmPixel pixel{};
    shared::FilmMoments moments{};
    shared::FilmFirstHit first_hit{};
    for (const float radiance : {bad, 1.0F, HUGE_VALF, 3.0F, -1.0F, 5.0F}) {
        f.kernel.add_path({glm::vec3(radiance, 2, 2 * radiance), 1, f.kernel.no_first_hit()}, pixel, moments, first_hit);
    }
    CHECK(pixel.samples == 3);
    CHECK(pixel.nonfinite == 3);
    CHECK(rounded(pixel.sum) == Rgb{9, 6, 18});
    // (1 + 9 + 25 - 81 / 3) / 2 / 3, and four times that.
    CHECK(pixel_standard_error(pixel, moments) == Rgb{std::sqrt(8.0 / 6), 0, 2 * std::sqrt(8.0 / 6)});
}
