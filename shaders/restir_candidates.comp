#version 460
#extension GL_GOOGLE_include_directive : require

#include "resampling_memory.glsl"
#include "candidates.kernel.h"
#include "wave.glsl"

layout(local_size_x = WAVE_GROUP) in;

shared uint group_listed;
shared uint first_listed;

// Pixels that need rays are listed, so that these are traced side by side however few there are.
void list(uvec2 pixel, uint needs) {
    if (gl_LocalInvocationIndex == 0u) {
        group_listed = 0u;
    }
    barrier();
    uint place = needs != 0u ? atomicAdd(group_listed, 1u) : 0u;
    barrier();
    if (gl_LocalInvocationIndex == 0u && group_listed > 0u) {
        first_listed = atomicAdd(addresses.candidate_list.command.x, group_listed);
    }
    barrier();
    if (needs != 0u) {
        addresses.candidate_list.entries[first_listed + place] = pixel_index(pixel) << 2 | needs;
    }
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    uvec2 pixel = uvec2(0u, 0u);
    uint needs = 0u;
    if (i < slice_pixels()) {
        pixel = path_pixel(i);
        needs = resample_candidates(pixel, dispatch_block.value.pass);
    }
    if (constants.resampling.bsdf_candidates != 0u) {
        list(pixel, needs);
    }
}
