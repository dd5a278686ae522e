// PathState as it is stored between passes. Included after path.kernel.h.
#ifndef WAVE_PATHS_GLSL
#define WAVE_PATHS_GLSL

#include "wave.glsl"

WavePath pack_path(PathState path) {
    WavePath packed;
    packed.origin = path.origin;
    packed.pdf_direction = path.pdf_direction;
    packed.direction = path.direction;
    packed.alpha_key = next_ray_key(path);
    packed.throughput = path.throughput;
    packed.state = path.depth | (path.only_strategy ? WAVE_ONLY_STRATEGY : 0u) |
                   (path.light_is_complete ? WAVE_LIGHT_IS_COMPLETE : 0u);
    packed.reference = path.reference;
    packed.rays = path.found.rays;
    packed.radiance = path.found.radiance;
    packed.facing = path.facing;
    return packed;
}

void store_path(uint slot, PathState path) {
    if (path.goes_on) {
        addresses.wave_paths.data[slot] = pack_path(path);
    } else {
        addresses.wave_paths.data[slot].radiance = path.found.radiance;
        addresses.wave_paths.data[slot].rays = path.found.rays;
    }
}

// Restores a path that continues. It has no light to test.
PathState unpack_path(WavePath packed, uvec2 pixel, uint sample_index) {
    PathState path;
    path.random = make_sampler(pixel, sample_index, constants.seed, constants.sampler_kind, constants.sample_count);
    path.found.radiance = packed.radiance;
    path.found.rays = packed.rays;
    path.found.first_hit = no_first_hit();
    path.origin = packed.origin;
    path.direction = packed.direction;
    path.throughput = packed.throughput;
    path.reference = packed.reference;
    path.facing = packed.facing;
    path.pdf_direction = packed.pdf_direction;
    path.only_strategy = (packed.state & WAVE_ONLY_STRATEGY) != 0u;
    path.goes_on = true;
    path.depth = packed.state & WAVE_DEPTH;
    path.direct = no_direct_light();
    path.reservoir = empty_reservoir();
    path.light_is_complete = (packed.state & WAVE_LIGHT_IS_COMPLETE) != 0u;
    return path;
}

#endif
