// What moves and switches in steps, so that at some frame the frame before had other lights or other occluders.
#pragma once

#include "chain_cases.h"

namespace diptych::core::tests {

/// One of a scene's steps a frame, so that a key at time f is frame f.
inline ChainCase stepped_case(const std::string& name, Scene scene) {
    ChainCase c = chain_case(name, std::move(scene));
    c.seconds = 1;
    return c;
}

inline int add_moving_node(Scene& scene, const std::string& name) {
    scene.nodes.emplace_back().name = name;
    return static_cast<int>(scene.nodes.size()) - 1;
}

inline void add_steps(Scene& scene, AnimatedProperty property, int target, std::vector<float> times,
                      std::vector<float> values) {
    scene.animations.resize(1);
    scene.animations[0].channels.push_back(
        {property, target, Interpolation::step, std::move(times), std::move(values)});
}

enum class Change { switches, moves };

/// A corner under two punctual lights of one kind. A dim one stays; a bright one is there at frames 0 and 1, is gone
/// from frame 2 on, and is back from frame 5 on: it is switched, or it turns away or sinks below the floor.
inline Scene punctual_corner(PunctualType type, Change change) {
    Scene scene;
    scene.name = "punctual";
    const int floor = add_material(scene, diffuse_material(0.8F));
    const int metal = add_material(scene, make_material("metal", {0.9F, 0.8F, 0.7F}, 1, 0.5F));
    Primitive wall;
    wall.material = metal;
    add_quad(wall, {-1, 0, -0.6F}, {1, 0, -0.6F}, {1, 1.5F, -0.6F}, {-1, 1.5F, -0.6F});
    add_object(scene, "corner", {horizontal_square({0, 0, 0}, 2, true, floor), wall});
    scene.cameras.push_back(make_camera("eye", {0, 0.8, 1.5}, {0, 0.2, -0.2}, 40));

    PunctualLight dim;
    dim.type = type;
    dim.light_to_world = make_camera("", {0.8, 1, 0.6}, {0, 0, -0.3}, 40).camera_to_world;
    dim.intensity = glm::vec3(0.7F);
    scene.lights.push_back(dim);
    // Shines along -Z, which a half turn of -90 degrees about x points down.
    const float h = std::sqrt(0.5F);
    PunctualLight bright = dim;
    bright.intensity = glm::vec3(1.5F);
    bright.node = add_moving_node(scene, "bright");
    scene.lights.push_back(bright);
    scene.nodes[0].translation = {-0.3, 1, 0.2};
    scene.nodes[0].rotation = {-h, 0, 0, h};
    const std::vector<float> times = {0, 2, 5};
    if (change == Change::switches) {
        scene.lights[1].moving_color = glm::vec3(1, 0.9F, 0.8F);
        add_steps(scene, AnimatedProperty::light_intensity, 1, times, {1.5F, 0, 1.5F});
    } else if (type == PunctualType::point) {
        add_steps(scene, AnimatedProperty::translation, 0, times, {-0.3F, 1, 0.2F, -0.3F, -1, -2, -0.3F, 1, 0.2F});
    } else {
        add_steps(scene, AnimatedProperty::rotation, 0, times, {-h, 0, 0, h, h, 0, 0, h, -h, 0, 0, h});
    }
    return scene;
}

/// A floor under a lamp, with a plate between them at frames 0 to 2 and again from frame 5 to 7.
inline Scene coming_and_going() {
    Scene scene;
    scene.name = "coming and going";
    const int floor = add_material(scene, diffuse_material(0.8F));
    const int black = add_material(scene, diffuse_material(0));
    const int lamp = add_material(scene, make_emitter("lamp", glm::vec3(5)));
    add_object(scene, "room",
               {horizontal_square({0, 0, 0}, 2, true, floor), horizontal_square({0.3F, 1, 0}, 0.25F, false, lamp),
                horizontal_square({-0.8F, 1, 0}, 0.1F, false, lamp)});
    add_object(scene, "plate", {horizontal_square({0, 0, 0}, 0.3F, true, black)});
    scene.instances.back().node = add_moving_node(scene, "plate");
    add_steps(scene, AnimatedProperty::translation, 0, {0, 3, 5, 8},
              {0.2F, 0.5F, 0, 0.2F, 0.5F, 5, 0.2F, 0.5F, 0, 0.2F, 0.5F, 5});
    scene.cameras.push_back(make_camera("eye", {0, 0.45, 1}, {0, 0, 0}, 30));
    return scene;
}

/// coming_and_going with visibility in the target.
inline ChainCase coming_and_going_case() {
    ChainCase c = stepped_case("coming and going", coming_and_going());
    c.settings.resampling.visibility = ResamplingVisibility::target;
    return c;
}

/// The first frames after each change, and the one before.
inline const std::vector<std::uint32_t> coming_and_going_frames = {2, 3, 4, 5, 6, 8, 9};

}  // namespace diptych::core::tests
