#version 460
#extension GL_GOOGLE_include_directive : require

#include "region.glsl"
#include "resampling_memory.glsl"
#include "restir/candidates.kernel.h"

shared uint group_listed;
shared uint first_listed;

// Appends the pixel to the list if it needs rays, so that the rays of listed pixels are traced side by side.
void list(bool listed, CandidateRequest request) {
    if (gl_LocalInvocationIndex == 0u) {
        group_listed = 0u;
    }
    barrier();
    uint place = listed ? atomicAdd(group_listed, 1u) : 0u;
    barrier();
    if (gl_LocalInvocationIndex == 0u && group_listed > 0u) {
        first_listed = atomicAdd(addresses.candidate_list.command.x, group_listed);
    }
    barrier();
    if (listed) {
        addresses.candidate_list.entries[first_listed + place] = request;
    }
}

void main() {
    CandidateRequest request;
    request.needs = 0u;
    if (is_in_region()) {
        request = resample_candidates(region_pixel(), dispatch_block.value.pass);
    }
    if (constants.resampling.bsdf_candidates != 0u) {
        list(needs_rays(request), request);
    }
}
