// Runs one of the measured functions over the inputs.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "measured_functions.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer Inputs { MeasuredInput inputs[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Outputs { MeasuredOutput outputs[]; };
layout(push_constant) uniform Run {
    uint count;
    uint chosen;
};

#define RUN(name)             \
    if (chosen == number) {   \
        measure_##name(p, o); \
    }                         \
    number += 1u;

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= count) {
        return;
    }
    MeasuredInput p = inputs[index];
    MeasuredOutput o;
    for (uint i = 0u; i < 12u; ++i) {
        o.y[i] = 0.0f;
    }
    for (uint i = 0u; i < 8u; ++i) {
        o.n[i] = 0u;
    }
    uint number = 0u;
    MEASURED_FUNCTIONS(RUN)
    outputs[index] = o;
}
