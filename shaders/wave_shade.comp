#version 460
#extension GL_GOOGLE_include_directive : require

#include "scene_hooks.glsl"
#include "path.kernel.h"
#include "wave_paths.glsl"

layout(local_size_x = WAVE_GROUP) in;

// What a group adds to the lists, and where: one atomic of the device a group.
shared uint group_rays;
shared uint group_shadows;
shared uint first_ray;
shared uint first_shadow;

// Where the rays have arrived.
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (gl_LocalInvocationIndex == 0u) {
        group_rays = 0u;
        group_shadows = 0u;
    }
    barrier();

    PathState path;
    uint slot = 0u;
    bool goes_on = false;
    bool shadow = false;
    uint ray = 0u;
    uint shadow_ray = 0u;
    if (i < addresses.wave_counts.data[this_wave()].rays.x) {
        slot = addresses.wave_queues.data[queue_place(this_wave(), i)];
        path = unpack_path(addresses.wave_paths.data[slot], path_pixel(slot), path_sample(slot));
        bool is_first = path.depth == 0u;
        extend_path(path, addresses.wave_hits.data[i]);
        if (feature(FEATURE_FIRST_HIT_LAYERS) && is_first) {
            addresses.wave_first_hits.data[slot] = path.found.first_hit;
        }
        goes_on = path.goes_on;
        shadow = awaits_shadow_ray(path);
        path.found.rays += shadow ? 1u : 0u;
        if (goes_on) {
            addresses.wave_paths.data[slot] = pack_path(path);
            ray = atomicAdd(group_rays, 1u);
        } else {
            addresses.wave_paths.data[slot].radiance = path.found.radiance;
            addresses.wave_paths.data[slot].rays = path.found.rays;
        }
        if (shadow) {
            shadow_ray = atomicAdd(group_shadows, 1u);
        }
    }
    barrier();

    if (gl_LocalInvocationIndex == 0u && group_rays > 0u) {
        first_ray = atomicAdd(addresses.wave_counts.data[next_wave()].rays.x, group_rays);
        uint groups = (first_ray + group_rays + WAVE_GROUP - 1u) / WAVE_GROUP;
        atomicMax(addresses.wave_counts.data[next_wave()].shading.x, groups);
    }
    if (gl_LocalInvocationIndex == 0u && group_shadows > 0u) {
        first_shadow = atomicAdd(addresses.wave_counts.data[next_wave()].shadows.x, group_shadows);
    }
    barrier();

    if (goes_on) {
        addresses.wave_queues.data[queue_place(next_wave(), first_ray + ray)] = slot;
    }
    if (shadow) {
        WaveShadow asked;
        asked.origin = path.origin;
        asked.t_max = path.direct.t_max;
        asked.direction = path.direct.direction;
        asked.alpha_key = shadow_ray_key(path);
        asked.radiance = path.direct.radiance;
        asked.path = slot;
        addresses.wave_shadows.data[first_shadow + shadow_ray] = asked;
    }
}
