// Everything that a renderer of sequences can get wrong, in one room: an occluder that slides and turns, a lamp that
// moves, one that goes on at 1 s and one that goes off at 2 s, a point light that fades, a camera that walks. 4 s long.
#include "generate/scenes.h"
#include "generate/shapes.h"
#include "pose/pose.h"

#include <cmath>

namespace diptych::core {
namespace {

constexpr float room_width = 4, room_height = 3, room_depth = 4;  // metres; open towards +Z

int add_node(Scene& scene, std::string name) {
    scene.nodes.emplace_back().name = std::move(name);
    return int(scene.nodes.size()) - 1;
}

void hang(Scene& scene, const std::string& name, int mesh) {
    add_instance(scene, name, mesh);
    scene.instances.back().node = add_node(scene, name);
}

/// Emission that an animation sets: dark at rest unless that is how it begins.
int add_switched(Scene& scene, const std::string& name, const glm::vec3& color) {
    Material lamp = make_emitter(name, color);
    lamp.moving_emission = MovingEmission{color, 1};
    return add_material(scene, lamp);
}

Primitive level_square(float half, int material) {
    Primitive out;
    out.material = material;
    add_quad(out, {-half, 0, -half}, {half, 0, -half}, {half, 0, half}, {-half, 0, half});
    return out;
}

void add_room(Scene& scene) {
    const int white = add_material(scene, make_material("white", glm::vec3(0.7F), 0, 1));
    const int red = add_material(scene, make_material("red", {0.6F, 0.06F, 0.05F}, 0, 1));
    const int green = add_material(scene, make_material("green", {0.1F, 0.45F, 0.1F}, 0, 1));
    const int glossy = add_material(scene, make_material("glossy", {0.8F, 0.6F, 0.3F}, 1, 0.25F));
    const float x = room_width / 2, z = room_depth / 2;
    Primitive shell, left, right, block;
    shell.material = white;
    add_quad(shell, {-x, 0, z}, {x, 0, z}, {x, 0, -z}, {-x, 0, -z});
    add_quad(shell, {-x, room_height, -z}, {x, room_height, -z}, {x, room_height, z}, {-x, room_height, z});
    add_quad(shell, {-x, 0, -z}, {x, 0, -z}, {x, room_height, -z}, {-x, room_height, -z});
    left.material = red;
    add_quad(left, {-x, 0, z}, {-x, 0, -z}, {-x, room_height, -z}, {-x, room_height, z});
    right.material = green;
    add_quad(right, {x, 0, -z}, {x, 0, z}, {x, room_height, z}, {x, room_height, -z});
    block.material = glossy;
    add_box(block, {0.5F, 0.001F, -1.4F}, {1.3F, 0.9F, -0.6F});
    add_object(scene, "room", {shell, left, right});
    add_object(scene, "block", {block});
}

using P = AnimatedProperty;
using I = Interpolation;

Animation turn_and_slide(int slab) {
    const float h = std::sqrt(0.5F);
    return {"occluder",
            {{P::translation, slab, I::linear, {0, 2, 4}, {-1.2F, 1.2F, 0, 1.2F, 1.2F, 0.3F, -1.2F, 1.2F, 0}},
             {P::rotation, slab, I::linear, {0, 2, 4}, {0, 0, 0, 1, 0, h, 0, h, 0, 1, 0, 0}}}};
}

/// Tangents of a circle about (0, 2.2, -0.3): a quarter turn a key.
Animation circle(int lamp) {
    const float r = 0.8F, speed = 1.25F;
    Channel path{P::translation, lamp, I::cubic_spline, {0, 1, 2, 3, 4}, {}};
    for (int key = 0; key < 5; ++key) {
        const float c = key % 4 == 0 ? 1.0F : key % 4 == 2 ? -1.0F : 0.0F;
        const float s = key % 4 == 1 ? 1.0F : key % 4 == 3 ? -1.0F : 0.0F;
        const float velocity[] = {-s * speed, 0, c * speed}, place[] = {c * r, 2.2F, s * r - 0.3F};
        for (const float* group : {velocity, place, velocity}) {
            path.values.insert(path.values.end(), group, group + 3);
        }
    }
    return {"moving lamp", {path}};
}

Animation walk(int camera) {
    // Half turns of 0.2 rad to the right and 0.4 rad to the left.
    constexpr float c1 = 0.99500417F, s1 = 0.09983342F, c2 = 0.98006658F, s2 = 0.19866933F;
    return {"camera",
            {{P::translation, camera, I::linear, {0, 4}, {-1.2F, 1.5F, 5.5F, 1.2F, 1.7F, 4.5F}},
             {P::rotation, camera, I::linear, {0, 4}, {0, -s1, 0, c1, 0, s2, 0, c2}}}};
}

}  // namespace

GeneratedScene generate_moving_light(const GenerateOptions&) {
    GeneratedScene out;
    Scene& scene = out.scene;
    scene.name = "moving-light";
    add_room(scene);
    const int dark = add_material(scene, make_material("dark", glm::vec3(0.3F), 0, 0.6F));
    const int warm = add_material(scene, make_emitter("warm", {14, 9, 5}));
    const int on = add_switched(scene, "goes on", {1, 0.9F, 0.7F});
    const int off = add_switched(scene, "goes off", {0.4F, 0.6F, 1});
    add_object(scene, "lamp that goes on", {level_square(0.2F, on)}, translation(-1.2, 2.9, 0.5));
    add_object(scene, "lamp that goes off", {level_square(0.2F, off)}, translation(1.2, 2.9, 0.5));

    Primitive slab;
    slab.material = dark;
    add_box(slab, {-0.4F, -0.5F, -0.05F}, {0.4F, 0.5F, 0.05F});
    hang(scene, "occluder", add_mesh(scene, "occluder", {slab}));
    hang(scene, "moving lamp", add_mesh(scene, "moving lamp", {level_square(0.12F, warm)}));
    const int slab_node = 0, lamp_node = 1, camera_node = add_node(scene, "moving");

    Camera still = make_camera("camera", {0, 1.5, 6}, {0, 1.4, 0}, 36);
    still.aspect = 4.0 / 3;
    Camera moving = still;
    moving.name = "moving";
    moving.node = camera_node;
    scene.cameras = {still, moving};

    PunctualLight spark;
    spark.name = "spark";
    spark.light_to_world = translation(0, 0.4, 1);
    spark.moving_color = glm::vec3(1, 0.5F, 0.2F);
    scene.lights = {spark};

    scene.animations = {
        turn_and_slide(slab_node),
        circle(lamp_node),
        {"switches",
         {{P::emissive_strength, on, I::step, {0, 1}, {0, 12}}, {P::emissive_strength, off, I::step, {0, 2}, {18, 0}}}},
        {"spark", {{P::light_intensity, 0, I::linear, {0, 1, 4}, {0, 1.5F, 0.25F}}}},
        walk(camera_node)};
    pose_scene(scene, 0);
    return out;
}

}  // namespace diptych::core
