// Where a ray starts so that it does not meet the surface it leaves.
#ifndef RAY_OFFSET_H
#define RAY_OFFSET_H

#include "numbers/elementary.h"

SHARED_BEGIN

CONST float OFFSET_ULPS = 64.0f;       // of the sizes that were added up along the normal
CONST float OFFSET_LEAST_ULPS = 2.0f;  // of the largest size: an axis-aligned wall through 0 has none along its normal

// Barycentrics of the points where rays leave a surface keep so far from 0. A point on the edge between two walls lies on both but for
// its rounding: beyond one of them, and a ray would leave the room. This is farther than the roundings of such a point and of an intersector's
// differences add up to (some 20 of 2^-24 of the coordinates), where a triangle is not small beside its distance from its origin.
CONST float EDGE_MARGIN = 9.5367431640625e-7f;  // 2^-20

/// Barycentrics of the second and third vertex, moved off the triangle's edges.
FN vec2 off_edges(vec2 barycentrics) {
    float margin = MUTANT(RAYS_FROM_EDGES, EDGE_MARGIN, 0.0f);
    PRECISE vec2 inside = vec2(max(barycentrics.x, margin), max(barycentrics.y, margin));
    PRECISE float sum = inside.x + inside.y;
    if (sum <= 1.0f - margin) {
        return inside;
    }
    PRECISE vec2 moved = inside * ((1.0f - margin) / sum);
    return moved;
}

/// The finite point moved off the surface, to the side that the unit normal points to. `magnitude` bounds, coordinate by coordinate,
/// what was added up to make the point: that, and not how far from 0 the sum came to lie, says how much rounding there may be. So the
/// step shrinks and grows with the scene (Waechter & Binder 2019, Ray Tracing Gems, chapter 6, take the point itself and a step for unit
/// scenes near 0; bounds as Pharr, Jakob & Humphreys 2016, section 3.9).
FN vec3 offset_ray(vec3 position, vec3 geometric_normal, vec3 magnitude) {
    PRECISE float ulps = OFFSET_ULPS * dot(abs(geometric_normal), magnitude) + OFFSET_LEAST_ULPS * max_component(magnitude);
    PRECISE vec3 moved = position + geometric_normal * (ulps * 1.1920929e-7f);
    return MUTANT(RAYS_NOT_OFFSET, moved, position);
}

SHARED_END

#endif
