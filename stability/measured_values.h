// What a measured function takes and gives, in the shared dialect: one source that C++ calls and a compute shader too.
#ifndef MEASURED_VALUES_H
#define MEASURED_VALUES_H

#include "leaves.h"

SHARED_BEGIN

/// Arguments; each function says which it reads.
struct MeasuredInput {
    float x[16];
    uint n[4];
};
ASSERT_SIZE(MeasuredInput, 80);

/// Results, likewise.
struct MeasuredOutput {
    float y[12];
    uint n[8];
};
ASSERT_SIZE(MeasuredOutput, 80);

FN vec3 measured_vec3(IN(MeasuredInput) p, uint first) {
    return vec3(p.x[first], p.x[first + 1u], p.x[first + 2u]);
}

FN void give_vec3(INOUT(MeasuredOutput) o, uint first, vec3 v) {
    o.y[first] = v.x;
    o.y[first + 1u] = v.y;
    o.y[first + 2u] = v.z;
}

SHARED_END

#endif
