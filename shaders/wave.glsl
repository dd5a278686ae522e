// A wave: all paths of a slice go on by one ray. Three passes do one thing each, so that rays of one kind are
// traced side by side and shading keeps no registers from tracing (Laine, Karras & Aila 2013; pbrt-v4's wavefront integrator). What they hand on lies
// in memory: a WavePath for every path; a queue of those that go on, and the hits of their rays in its order; the shadow rays.
#ifndef WAVE_GLSL
#define WAVE_GLSL

#include "dispatch_block.glsl"

// The place of entry i of a wave's queue. There are two: one is read while the next wave's is written.
uint queue_place(uint wave, uint i) { return (wave & 1u) * dispatch_block.value.path_capacity + i; }
uint this_wave() { return dispatch_block.value.wave; }
uint next_wave() { return dispatch_block.value.wave + 1u; }

uint slice_pixels() { return dispatch_block.value.region.x * dispatch_block.value.region.y; }
uint slice_paths() { return slice_pixels() * dispatch_block.value.sample_count; }

// Sample by sample, as the pixels lie in the slice.
uvec2 path_pixel(uint path) {
    uint in_slice = path % slice_pixels();
    uint width = dispatch_block.value.region.x;
    return dispatch_block.value.origin + uvec2(in_slice % width, in_slice / width);
}
uint path_sample(uint path) { return dispatch_block.value.first_sample + path / slice_pixels(); }

#endif
