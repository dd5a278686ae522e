// Draws from the sampler that the setup names, one an invocation.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "draws.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer Setup { DrawSetup setup; };
layout(set = 0, binding = 1, scalar) writeonly buffer Results { Drawn drawn[]; };
layout(push_constant) uniform Run {
    uint count;
    uint first;
};

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index < count) {
        drawn[index] = draw_sample(setup, first + index);
    }
}
