// A wave: all paths of a slice advance by one ray. Three passes do one task each, so that rays of one kind are traced
// side by side, and shading shares no registers with tracing (Laine, Karras and Aila 2013; pbrt-v4's wavefront
// integrator). Data between the passes are in memory: a WavePath for every path; a queue of the paths that continue,
// and the hits of their rays in the same order; the shadow rays.
#ifndef WAVE_GLSL
#define WAVE_GLSL

#include "dispatch_block.glsl"

// Index of entry i in a wave's queue. There are two queues: one is read while the next wave's is written.
uint queue_place(uint wave, uint i) { return (wave & 1u) * dispatch_block.value.path_capacity + i; }
uint this_wave() { return dispatch_block.value.wave; }
uint next_wave() { return dispatch_block.value.wave + 1u; }

uint slice_pixels() { return dispatch_block.value.region.x * dispatch_block.value.region.y; }
uint slice_paths() { return slice_pixels() * dispatch_block.value.sample_count; }

// Paths are in order of sample, then of pixel within the slice.
uvec2 path_pixel(uint path) {
    uint in_slice = path % slice_pixels();
    uint width = dispatch_block.value.region.x;
    return dispatch_block.value.origin + uvec2(in_slice % width, in_slice / width);
}
uint path_sample(uint path) { return dispatch_block.value.first_sample + path / slice_pixels(); }

#endif
