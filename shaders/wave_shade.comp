#version 460
#extension GL_GOOGLE_include_directive : require

#include "scene_hooks.glsl"
#include "path/path.kernel.h"
#include "wave_paths.glsl"
#include "wave_lists.glsl"

layout(local_size_x = WAVE_GROUP) in;

// Shades the hits of the rays. A path that ends stores its radiance.
void main() {
    uint i = gl_GlobalInvocationID.x;
    uint slot = 0u;
    bool goes_on = false;
    bool has_shadow = false;
    WaveShadow asked;
    if (i < addresses.wave_counts.data[this_wave()].rays.x) {
        slot = addresses.wave_queues.data[queue_place(this_wave(), i)];
        PathState path = unpack_path(addresses.wave_paths.data[slot], path_pixel(slot), path_sample(slot));
        bool is_first = path.depth == 0u;
        extend_path(path, addresses.wave_hits.data[i]);
        if (feature(FEATURE_FIRST_HIT_LAYERS) && is_first) {
            addresses.wave_first_hits.data[slot] = path.found.first_hit;
        }
        goes_on = path.goes_on;
        has_shadow = awaits_shadow_ray(path);
        if (has_shadow) {
            path.found.rays += 1u;
            asked.origin = path.origin;
            asked.t_max = path.direct.t_max;
            asked.direction = path.direct.direction;
            asked.alpha_key = shadow_ray_key(path);
            asked.radiance = path.direct.radiance;
            asked.path = slot;
        }
        store_path(slot, path);
    }
    append(next_wave(), slot, goes_on, has_shadow, asked);
}
