// What chains are of, and the test of their frames.
#pragma once

#include <cstdio>

#include "../cpu/render_fixture.h"
#include "catch.h"
#include "chains.h"
#include "settings/names.h"
#include "generate/generate.h"

namespace diptych::core::tests {

inline std::unique_ptr<Renderer> on_cpu(const PackedScene& packed) {
    return make_cpu_renderer(packed, 0);
}

inline Scene generated(const std::string& name, int count = 0) {
    GenerateOptions options;
    if (count > 0) {
        options.count = count;
    }
    return generate_scene(name, options).scene;
}

inline ChainCase chain_case(const std::string& name, Scene scene) {
    ChainCase c;
    c.name = name;
    c.scene = std::move(scene);
    c.settings.integrator = Integrator::restir;
    c.settings.max_depth = 1;
    c.settings.resampling.neighbors = 3;
    c.settings.resampling.radius = 5;
    c.settings.resampling.confidence_cap = 20;  // a long memory shows faults of reuse the more
    return c;
}

/// A floor whose pixels see the lamp or do not, by turns: black slats stand between, which may glow a little. Glossy,
/// it shows the lamp's image through them.
inline Scene slats(bool glossy, float glow = 0) {
    Scene scene;
    scene.name = "slats";
    Material floor = diffuse_material(0.8F);
    if (glossy) {
        floor = make_material("floor", glm::vec3(0.9F), 1, 0.3F);
    }
    const int floor_material = add_material(scene, floor);
    Material slats = diffuse_material(0);
    slats.emission = glm::vec3(glow);
    const int black = add_material(scene, slats);
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

/// A floor that would be lit most by a lamp that no pixel sees, and is lit by a farther one of the same power: a
/// reservoir's sum of weights tells whether its sample is visible.
inline Scene hidden_lamp() {
    Scene scene;
    scene.name = "hidden lamp";
    const int floor = add_material(scene, diffuse_material(0.8F));
    const int black = add_material(scene, diffuse_material(0));
    const int lamp = add_material(scene, make_emitter("lamp", glm::vec3(5)));
    add_object(scene, "room",
               {horizontal_square({0, 0, 0}, 2, true, floor), horizontal_square({-0.6F, 0.5F, 0}, 0.1F, false, lamp),
                horizontal_square({-0.6F, 0.49F, 0}, 0.15F, false, black),
                horizontal_square({1.5F, 2, 0}, 0.1F, false, lamp)});
    scene.cameras.push_back(make_camera("eye", {0, 0.4, 0.5}, {0, 0, 0}, 20));
    return scene;
}

/// A floor under a bulb that hangs so low that it outshines, where it is, a ceiling of a thousand lamps of which each
/// has 25 times its power.
inline Scene bulb_close_by() {
    Scene scene;
    scene.name = "bulb";
    const int floor = add_material(scene, diffuse_material(0.8F));
    const int lamp = add_material(scene, make_emitter("lamp", glm::vec3(100)));
    std::vector<Primitive> parts{horizontal_square({0, 0, 0}, 2, true, floor),
                                 horizontal_square({0.002F, 0.01F, 0}, 0.002F, false, lamp)};
    for (int i = 0; i < 1024; ++i) {
        parts.push_back(horizontal_square({0.1F * static_cast<float>(i % 32), 3, 0.1F * static_cast<float>(i / 32)},
                                          0.01F, false, lamp));
    }
    add_object(scene, "room", parts);
    scene.cameras.push_back(make_camera("eye", {0, 0.06, 0.06}, {0, 0, 0}, 30));
    return scene;
}

/// A floor under one lamp, half a metre wide.
inline Scene lamp_overhead(float height) {
    Scene scene;
    scene.name = "lamp overhead";
    const int floor = add_material(scene, diffuse_material(0.8F));
    const int lamp = add_material(scene, make_emitter("lamp", glm::vec3(5)));
    add_object(scene, "room",
               {horizontal_square({0, 0, 0}, 2, true, floor), horizontal_square({0, height, 0}, 0.25F, false, lamp)});
    scene.cameras.push_back(make_camera("eye", {0, 0.3, 0.5}, {0, 0, 0}, 20));
    return scene;
}

/// A floor under a lamp and a sheet that half of the light passes, and under a sky.
inline Scene sheet(bool glossy) {
    Scene scene = lamp_overhead(0.4F);
    scene.name = "sheet";
    if (glossy) {
        scene.materials[0] = make_material("floor", glm::vec3(0.9F), 1, 0.3F);
    }
    Material film = diffuse_material(0.5F);
    film.alpha_mode = AlphaMode::blend;
    film.base_color.a = 0.5F;
    add_object(scene, "sheet", {horizontal_square({0, 0.2F, 0}, 1, true, add_material(scene, film))});
    scene.environment.kind = EnvironmentKind::constant;
    scene.environment.scale = glm::vec3(0.2F);
    return scene;
}

/// A glossy floor under a sky and nothing else.
inline Scene under_sky() {
    Scene scene;
    scene.name = "sky";
    const int floor = add_material(scene, make_material("floor", glm::vec3(0.9F), 1, 0.3F));
    add_object(scene, "floor", {horizontal_square({0, 0, 0}, 2, true, floor)});
    scene.environment.kind = EnvironmentKind::constant;
    scene.environment.scale = glm::vec3(0.2F);
    scene.cameras.push_back(make_camera("eye", {0, 0.3, 0.5}, {0, 0, 0}, 20));
    return scene;
}

/// `moving-light` with nothing moving but what one animation moves; a frame is 1/8 s. Of the switches only one.
inline ChainCase moving_case(const std::string& name, const std::string& animation, double start,
                             std::size_t channel = 0) {
    ChainCase c = chain_case(name, generated("moving-light"));
    std::vector<Animation> kept;
    for (const Animation& a : c.scene.animations) {
        if (a.name == animation) {
            kept.push_back(a);
            if (animation == "switches") {
                kept.back().channels = {a.channels.at(channel)};
            }
        }
    }
    c.scene.animations = kept;
    c.start = start;
    c.seconds = 0.125;
    return c;
}

/// One thing at a time: a switch is thrown at frame 4.
inline std::vector<ChainCase> moving_cases() {
    std::vector<ChainCase> cases = {
        moving_case("moving occluder", "occluder", 0.5), moving_case("light switched on", "switches", 0.5, 0),
        moving_case("light switched off", "switches", 1.5, 1), moving_case("moving emitter", "moving lamp", 0.5),
        moving_case("moving camera", "camera", 0.5)};
    cases.back().settings.camera = 1;
    return cases;
}

inline const std::vector<std::uint32_t> chain_frames = {0, 1, 2, 4, 8, 16, 64};

inline std::string variant_name(const ResamplingSettings& s) {
    return std::string(name_of(s.mis)) + ", visibility in " + name_of(s.visibility);
}

/// Every frame's mean against the reference's. |z| < 4.5: 6.8e-6 a frame.
inline void check_frames(const ChainCase& c, const std::vector<std::uint32_t>& frames, double widest_percent,
                         const ChainSize& size = {}, const MakeRenderer& make = on_cpu) {
    const auto means = run_chains(c, size, frames, make, 17);
    std::vector<double> reference;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        if (i == 0 || c.seconds > 0 || c.orbit != 0) {
            const bool still = c.seconds == 0 && c.orbit == 0;
            reference = run_reference(c, size, frames[i], still ? 32 : 16, 128, make);
        }
        const Difference d = difference(means[i], reference);
        std::printf("%s, %s, frame %u: %.2f %% +- %.2f %%, z %.2f\n", c.name.c_str(),
                    variant_name(c.settings.resampling).c_str(), frames[i], d.percent, d.half_width, d.z);
        INFO(c.name << ", " << variant_name(c.settings.resampling) << ", frame " << frames[i] << ": " << d.percent
                    << " % +- " << d.half_width << " %, z " << d.z);
        CHECK(std::abs(d.z) < 4.5);
        CHECK(d.half_width < widest_percent);
    }
}

}  // namespace diptych::core::tests
