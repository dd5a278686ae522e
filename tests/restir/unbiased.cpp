// ReSTIR against `path`, frame by frame: early frames, later ones, and scenes whose lights and occluders change under the reservoirs.
#include "backend/cpu_renderer.h"
#include "catch.h"
#include "chains.h"
#include "../cpu/render_fixture.h"
#include "render/settings_names.h"
#include "scene/generate.h"

namespace diptych::tests {
namespace {

std::unique_ptr<Renderer> on_cpu(const PackedScene& packed) { return make_cpu_renderer(packed, 0); }

Scene generated(const std::string& name, int count = 0) {
    GenerateOptions options;
    if (count > 0) {
        options.count = count;
    }
    return generate_scene(name, options).scene;
}

ChainCase chain_case(const std::string& name, Scene scene) {
    ChainCase c;
    c.name = name;
    c.scene = std::move(scene);
    c.settings.integrator = Integrator::restir;
    c.settings.max_depth = 1;
    c.settings.resampling.neighbors = 3;
    c.settings.resampling.radius = 5;
    return c;
}

/// A floor whose pixels see the lamp or do not, by turns: black slats stand between. Glossy, it shows the lamp's image through them.
Scene slats(bool glossy) {
    Scene scene;
    scene.name = "slats";
    Material floor = diffuse_material(0.8F);
    if (glossy) {
        floor = make_material("floor", glm::vec3(0.9F), 1, 0.35F);
    }
    const int floor_material = add_material(scene, floor);
    const int black = add_material(scene, diffuse_material(0));
    const int lamp = add_material(scene, make_emitter("lamp", glm::vec3(glossy ? 5.0F : 200.0F)));
    std::vector<Primitive> parts{horizontal_square({0, 0, 0}, 2, true, floor_material),
                                 horizontal_square({-0.6F, 1.5F, 0}, glossy ? 0.4F : 0.03F, false, lamp)};
    for (int i = -6; i <= 6; ++i) {
        Primitive slat;
        slat.material = black;
        const float x = 0.2F * static_cast<float>(i);
        const float y = 0.3F;
        add_quad(slat, {x, y, 1}, {x + 0.1F, y, 1}, {x + 0.1F, y, -1}, {x, y, -1});
        parts.push_back(slat);
    }
    add_object(scene, "room", parts);
    scene.cameras.push_back(make_camera("eye", {0.6, 1.5, 0.02}, {0, 0, 0}, 40));
    return scene;
}

/// A floor that would be lit most by a lamp that no pixel sees, and is lit by a farther one of the same power: a reservoir's sum of weights
/// tells whether its sample is visible.
Scene hidden_lamp() {
    Scene scene;
    scene.name = "hidden lamp";
    const int floor = add_material(scene, diffuse_material(0.8F));
    const int black = add_material(scene, diffuse_material(0));
    const int lamp = add_material(scene, make_emitter("lamp", glm::vec3(5)));
    add_object(scene, "room",
               {horizontal_square({0, 0, 0}, 2, true, floor), horizontal_square({-0.6F, 0.5F, 0}, 0.1F, false, lamp),
                horizontal_square({-0.6F, 0.49F, 0}, 0.15F, false, black), horizontal_square({1.5F, 2, 0}, 0.1F, false, lamp)});
    scene.cameras.push_back(make_camera("eye", {0, 0.4, 0.5}, {0, 0, 0}, 20));
    return scene;
}

std::string variant_name(const ResamplingSettings& s) {
    return std::string(name_of(s.mis)) + ", visibility in " + name_of(s.visibility);
}

/// Every frame's mean against the reference's. |z| < 4.5: 6.8e-6 a frame.
void check_frames(const ChainCase& c, const std::vector<std::uint32_t>& frames, double widest_percent,
                  const ChainSize& size = {}) {
    const auto means = run_chains(c, size, frames, on_cpu, 17);
    std::vector<double> reference;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        if (i == 0 || c.seconds > 0 || c.orbit != 0) {
            const bool still = c.seconds == 0 && c.orbit == 0;
            reference = run_reference(c, size, frames[i], still ? 32 : 16, still ? 128 : 64, on_cpu);
        }
        const Difference d = difference(means[i], reference);
        INFO(c.name << ", " << variant_name(c.settings.resampling) << ", frame " << frames[i] << ": " << d.percent
                    << " % +- " << d.half_width << " %, z " << d.z);
        CHECK(std::abs(d.z) < 4.5);
        CHECK(d.half_width < widest_percent);
    }
}

}  // namespace

TEST_CASE("restir is unbiased at every frame, whatever its weights and wherever it puts visibility") {
    for (const ResamplingMis mis : {ResamplingMis::pairwise, ResamplingMis::balance, ResamplingMis::one_over_z}) {
        for (const ResamplingVisibility visibility : {ResamplingVisibility::shading, ResamplingVisibility::target}) {
            ChainCase c = chain_case("many lights", generated("many-lights", 300));
            c.settings.resampling.mis = mis;
            c.settings.resampling.visibility = visibility;
            check_frames(c, {0, 1, 8}, 12);
        }
    }
}

TEST_CASE("restir is unbiased where neighbours see the lamp by turns") {
    for (const bool glossy : {false, true}) {
        ChainCase c = chain_case(glossy ? "glossy slats" : "slats", slats(glossy));
        if (glossy) {
            c.settings.resampling.light_candidates = 1;  // so that the material's own candidate counts
        }
        check_frames(c, {0, 1, 8}, 6);
        c.settings.resampling.visibility = ResamplingVisibility::target;
        check_frames(c, {0, 1, 8}, 6);
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

TEST_CASE("restir is unbiased under a moving camera") {
    ChainCase c = chain_case("orbit", generated("cornell"));
    c.orbit = 3;
    check_frames(c, {0, 1, 4, 8}, 1.5);
}

TEST_CASE("ris is unbiased on glossy surfaces, where material sampling finds the light too") {
    for (const Integrator integrator : {Integrator::ris, Integrator::restir}) {
        ChainCase c = chain_case("veach", generated("veach-mis"));
        c.settings.integrator = integrator;
        check_frames(c, {0, 3}, 20);
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

TEST_CASE("MIS between lights and material knows what is hidden", "[nightly]") {
    ChainCase c = chain_case("glossy slats", slats(true));
    c.settings.resampling.light_candidates = 1;
    check_frames(c, {8, 16}, 1.5, {16, 48});
}

TEST_CASE("Long chains of restir stay unbiased", "[nightly]") {
    const ChainSize many{16, 48};
    const std::vector<std::uint32_t> frames{0, 1, 2, 4, 8, 16, 64};
    ChainCase lights = chain_case("many lights", generated("many-lights", 300));
    check_frames(lights, frames, 3, many);
    ChainCase box = chain_case("cornell", generated("cornell"));
    box.settings.max_depth = 3;
    check_frames(box, frames, 0.5, many);
    ChainCase moving = chain_case("moving light", generated("moving-light"));
    moving.seconds = 1.0 / 24;
    check_frames(moving, frames, 1, many);
    ChainCase glossy = chain_case("veach", generated("veach-mis"));
    check_frames(glossy, frames, 5, many);
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

}  // namespace diptych::tests
