// Where a ray starts so that it does not meet the surface it leaves.
#ifndef RAY_OFFSET_H
#define RAY_OFFSET_H

#include "compat.h"

SHARED_BEGIN

/// One coordinate: a step of up to 256 ulps along the normal, or a fixed one close to zero, where ulps are too small.
FN float offset_coordinate(float position, float normal) {
    int step_ulps = int(256.0f * normal);
    int bits = floatBitsToInt(position);
    int sign = bits >> 31;  // -1 below zero, else 0
    int stepped = bits + ((step_ulps ^ sign) - sign);
    PRECISE float near_zero = position + normal * (1.0f / 65536.0f);
    // Chosen by a mask: a CPU would guess.
    int stays_near = ((bits & 0x7fffffff) - 0x3d000000) >> 31;  // -1 where |position| < 1/32, else 0
    return intBitsToFloat((floatBitsToInt(near_zero) & stays_near) | (stepped & ~stays_near));
}

/// The finite point moved off the surface, to the side that the unit normal points to (Waechter & Binder 2019, Ray
/// Tracing Gems, chapter 6).
FN vec3 offset_ray(vec3 position, vec3 geometric_normal) {
    return vec3(offset_coordinate(position.x, geometric_normal.x), offset_coordinate(position.y, geometric_normal.y),
                offset_coordinate(position.z, geometric_normal.z));
}

SHARED_END

#endif
