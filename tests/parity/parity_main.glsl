// Runs one of PROBES over the inputs. A shader a header: four are compiled sooner than one a probe.
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer Inputs { ProbeInput inputs[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Outputs { ProbeOutput outputs[]; };
layout(push_constant) uniform Run {
    uint count;
    uint chosen;  // the probe, counted within PROBES
};

#define RUN(name, bound, diverging, why) \
    if (chosen == number) {              \
        probe_##name(p, o);              \
    }                                    \
    number += 1u;

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= count) {
        return;
    }
    ProbeInput p = inputs[index];
    ProbeOutput o;
    o.exact_count = 0u;
    o.value_count = 0u;
    o.path = 0u;
    o.too_sharp = 0u;
    uint number = 0u;
    PROBES(RUN)
    outputs[index] = o;
}
