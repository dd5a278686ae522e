// The topics of a random scene, one source file each.
#pragma once

#include "random_scene/draws.h"
#include "random_scene/random_scene.h"

namespace diptych::core {

/// Images and textures for the materials to choose from: colours and factors, normal maps.
struct TexturePool {
    std::vector<int> values;
    std::vector<int> normals;
};
TexturePool add_textures(Scene& scene, Draws draws);

/// Of the instance that the walls around everything are; it comes last.
inline constexpr const char* room_name = "room";

inline bool has_room(const Scene& scene) {
    return scene.instances.back().name == room_name;
}

enum class Role {
    object,
    lamp,  // emits in any case
    room,  // around everything: dim, of a strong colour
};

/// Any material at all, added to the scene.
int add_random_material(Scene& scene, const TexturePool& textures, Role role, Draws draws);

/// Objects in view, with lamps and walls around them; each primitive gets its material from `add_random_material`.
void add_random_meshes(Scene& scene, const TexturePool& textures, std::uint64_t seed);

/// Punctual lights, and the environment. A scene without any other light gets a constant one.
void add_random_lights(RandomScene& out, Draws draws);

void add_random_cameras(RandomScene& out, Draws draws);
/// In a room, light is followed over more bounces.
void draw_settings(RenderSettings& settings, bool in_room, Draws draws);

/// Animations of what the scene has, and the nodes that they move.
void add_random_motion(RandomScene& out, Draws draws);

}  // namespace diptych::core
