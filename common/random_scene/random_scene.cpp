#include "random_scene/random_scene.h"

#include <fmt/format.h>

#include "random_scene/parts.h"

namespace diptych::core {

RandomScene make_random_scene(std::uint64_t seed) {
    RandomScene out;
    out.seed = seed;
    out.scene.name = fmt::format("random-{}", seed);
    const TexturePool textures = add_textures(out.scene, Draws(seed, Topic::textures));
    add_random_meshes(out.scene, textures, seed);
    add_random_lights(out, Draws(seed, Topic::lights));
    add_random_cameras(out, Draws(seed, Topic::camera));
    draw_settings(out.settings, has_room(out.scene), Draws(seed, Topic::settings));
    return out;
}

RandomScene make_moving_random_scene(std::uint64_t seed) {
    RandomScene out = make_random_scene(seed);
    add_random_motion(out, Draws(seed, Topic::motion));
    return out;
}

}  // namespace diptych::core
