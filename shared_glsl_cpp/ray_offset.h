// Where a ray starts so that it does not meet the surface it leaves.
#ifndef RAY_OFFSET_H
#define RAY_OFFSET_H

#include "compat.h"

SHARED_BEGIN

/// One coordinate: a step of up to 256 ulps along the normal, or a fixed one close to zero, where ulps are too small.
FN float offset_coordinate(float position, float normal) {
    int step_ulps = int(256.0f * normal);
    int stepped = floatBitsToInt(position) + (position < 0.0f ? -step_ulps : step_ulps);
    PRECISE float near_zero = position + normal * (1.0f / 65536.0f);
    // Chosen as integers, which CPUs do without a branch.
    return intBitsToFloat(abs(position) < 1.0f / 32.0f ? floatBitsToInt(near_zero) : stepped);
}

/// The finite point moved off the surface, to the side that the unit normal points to (Waechter & Binder 2019, Ray
/// Tracing Gems, chapter 6).
FN vec3 offset_ray(vec3 position, vec3 geometric_normal) {
    return vec3(offset_coordinate(position.x, geometric_normal.x), offset_coordinate(position.y, geometric_normal.y),
                offset_coordinate(position.z, geometric_normal.z));
}

SHARED_END

#endif
