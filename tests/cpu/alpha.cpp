// Stochastic alpha attenuates by what it says, for direct rays and shadow rays alike.
#include <numbers>

#include "agreement_scenes.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

Material pane_material(float alpha, AlphaMode mode) {
    Material m = diffuse_material(0);
    m.base_color.w = alpha;
    m.alpha_mode = mode;
    m.alpha_cutoff = 0.5F;
    return m;
}

/// A floor under a square light, with `panes` of one material between them and before the camera.
Scene pane_scene(const Material& pane, int panes) {
    Scene scene;
    scene.name = "panes";
    const int floor = add_material(scene, diffuse_material(0.5F));
    const int light = add_material(scene, make_emitter("light", glm::vec3(1)));
    const int glass = add_material(scene, pane);
    add_object(scene, "floor", {horizontal_square(glm::vec3(0), 20, true, floor)});
    add_object(scene, "light", {horizontal_square({0, 1, 0}, 0.5F, false, light)});
    for (int i = 0; i < panes; ++i) {
        add_object(scene, "pane", {horizontal_square({0, 0.8F + 0.05F * static_cast<float>(i), 0}, 3, true, glass)});
    }
    return scene;
}

}  // namespace

TEST_CASE("A pane of alpha 0.3 lets 0.7 pass, in view and in shadow") {
    for (const int panes : {1, 2}) {
        Scene scene = pane_scene(pane_material(0.3F, AlphaMode::blend), panes);
        const double passed = std::pow(0.7, panes);
        for (const Integrator integrator : integrators) {
            scene.cameras = {point_camera({0.03, 0.5, 0.02}, {0.1, 1, 0.15})};
            const ImageMean seen = image_mean(render_cpu(scene, statistical_settings(16, 16, integrator, 0), 1024));
            INFO(name_of(integrator) << " seen " << describe(seen) << "truth " << passed);
            CHECK(worst_z(seen, exactly(passed)) < 4.5);
            CHECK(relative_error(seen, exactly(passed)) < 2.5e-3);
            scene.cameras = {point_camera({0.6, 0.4, 0.3}, {0, 0, 0})};
            const double truth = passed * 0.752275 * 0.5 / std::numbers::pi;
            const std::uint32_t spp = integrator == Integrator::brdf ? 6144 : 1024;
            const ImageMean lit = image_mean(render_cpu(scene, statistical_settings(16, 16, integrator, 1), spp));
            INFO("lit " << describe(lit) << "truth " << truth);
            CHECK(worst_z(lit, exactly(truth)) < 4.5);
            CHECK(relative_error(lit, exactly(truth)) < 3e-3);
        }
    }
}

TEST_CASE("MASK is all or nothing, and an opaque material ignores its alpha") {
    const auto seen = [](const Material& pane) {
        Scene scene = pane_scene(pane, 1);
        scene.cameras = {point_camera({0.03, 0.5, 0.02}, {0.1, 1, 0.15})};
        return image_mean(render_cpu(scene, statistical_settings(4, 4, Integrator::path, 0), 16)).mean[0];
    };
    CHECK(seen(pane_material(0.49F, AlphaMode::mask)) == Approx(1));
    CHECK(seen(pane_material(0.5F, AlphaMode::mask)) == 0);
    CHECK(seen(pane_material(0.0F, AlphaMode::opaque)) == 0);
    CHECK(seen(pane_material(0.0F, AlphaMode::blend)) == Approx(1));
    CHECK(seen(pane_material(1.0F, AlphaMode::blend)) == 0);
}

TEST_CASE("Vertex alpha counts toward a pane's coverage") {
    Scene scene = pane_scene(pane_material(0.5F, AlphaMode::blend), 1);
    scene.meshes.back().primitives[0].colors.assign(4, glm::vec4(1, 1, 1, 0.5F));
    scene.cameras = {point_camera({0.03, 0.5, 0.02}, {0.1, 1, 0.15})};
    const ImageMean m = image_mean(render_cpu(scene, statistical_settings(16, 16, Integrator::path, 0), 1024));
    CHECK(worst_z(m, exactly(0.75)) < 4.5);
}
