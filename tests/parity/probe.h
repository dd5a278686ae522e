// What a probe takes and gives, in the shared dialect, so that one source calls a shared function in C++ and in a
// shader.
#ifndef PROBE_H
#define PROBE_H

#include "leaves.h"
#include "film/tonemap.h"

SHARED_BEGIN

/// Arguments that all probes choose from, drawn on the host (probe_inputs.h), so that both languages see the same bits.
struct ProbeInput {
    uvec4 words;    // any bits
    uvec2 set;      // x < y <= HAMMERSLEY_MAX_COUNT
    vec4 u;         // multiples of 2^-24 in [0, 1)
    float angle;    // |.| <= SIN_COS_MAX
    float number;   // of either sign and every size from 2^-60 to 2^60
    float other;    // the same
    float special;  // the same, or 0, infinity, NaN
    float alpha;    // [ALPHA_MIRROR, 1]
    vec3 wo;        // unit, z > 0, down to 1.2e-7
    vec3 wi;
    vec3 facet;  // unit, z > 0, tan(theta) a few alpha
    vec3 axis;   // unit
    vec3 axis_2;
    vec3 shading;  // unit, on the axis's side
    vec3 mapped;   // unit, tilted from it
    vec3 view;     // unit, mostly on the axis's side
    vec3 light;
    vec3 vertex;  // of a triangle, seen from 0
    vec3 edge_1;
    vec3 edge_2;
    vec3 color;  // [0, 1]
    vec3 color_2;
    vec3 radiance;  // positive, of every size; components may be infinite, negative or NaN
};
ASSERT_SIZE(ProbeInput, 240);

CONST uint PROBE_EXACT = 20u;
CONST uint PROBE_VALUES = 16u;

/// Results. The host compares `exact` bit for bit; a value may differ by bound * 2^-23 * scale, where the scale says
/// how far rounding of the arguments' own order moves the result. Where `path` differs, the two took different
/// branches: they may, in a stated share of the inputs, and their values are then not compared.
struct ProbeOutput {
    uint exact[PROBE_EXACT];
    float value[PROBE_VALUES];
    float scale[PROBE_VALUES];
    uint exact_count;
    uint value_count;
    uint path;
    uint too_sharp;  // 1: values were left out, as rounding alone moves them too far for a comparison to mean anything
};
ASSERT_SIZE(ProbeOutput, 224);

FN void put_bits(INOUT(ProbeOutput) o, uint bits) {
    o.exact[o.exact_count] = bits;
    o.exact_count += 1u;
}

FN void put_bits2(INOUT(ProbeOutput) o, uvec2 bits) {
    put_bits(o, bits.x);
    put_bits(o, bits.y);
}

FN void put_bits4(INOUT(ProbeOutput) o, uvec4 bits) {
    put_bits(o, bits.x);
    put_bits(o, bits.y);
    put_bits(o, bits.z);
    put_bits(o, bits.w);
}

/// For floats that no backend may round in another way.
FN void put_same3(INOUT(ProbeOutput) o, vec3 v) {
    put_bits(o, floatBitsToUint(v.x));
    put_bits(o, floatBitsToUint(v.y));
    put_bits(o, floatBitsToUint(v.z));
}

FN void put(INOUT(ProbeOutput) o, float value, float scale) {
    o.value[o.value_count] = value;
    o.scale[o.value_count] = scale;
    o.value_count += 1u;
}

FN void put3(INOUT(ProbeOutput) o, vec3 value, float scale) {
    put(o, value.x, scale);
    put(o, value.y, scale);
    put(o, value.z, scale);
}

/// Scaled by the value itself.
FN void put_relative(INOUT(ProbeOutput) o, float value) {
    put(o, value, abs(value));
}

FN void put_path(INOUT(ProbeOutput) o, bool branch) {
    o.path = o.path * 2u + (branch ? 1u : 0u);
}

/// Whether a relative scale still lets a difference show: beyond it, first order says nothing.
FN bool put_comparable(INOUT(ProbeOutput) o, float scale) {
    bool comparable = scale < 1.0e4f;
    o.too_sharp = comparable ? 0u : 1u;
    put_path(o, comparable);
    return comparable;
}

/// |a| . |b|: what a dot product may lose.
FN float dot_scale(vec3 a, vec3 b) {
    return dot(abs(a), abs(b));
}

SHARED_END

#endif
