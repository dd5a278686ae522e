// Origins of rays that leave a surface, moved so that a ray does not hit that surface again.
#ifndef RAY_OFFSET_H
#define RAY_OFFSET_H

#include "numbers/elementary.h"

SHARED_BEGIN

CONST float OFFSET_ULPS = 64.0f;       // times the magnitude along the normal
CONST float OFFSET_LEAST_ULPS = 2.0f;  // times the largest magnitude: along the normal it may be 0

// Smallest barycentric of a point where rays leave a surface. Up to rounding, a point on the edge between two walls
// lies on both. Rounding may put the ray's origin beyond one of the walls, and the ray would leave the room. The
// margin exceeds the rounding of such a point and of an intersector's differences (about 20 · 2^-24 of the
// coordinates), unless the triangle is small compared with its distance from the origin of its coordinates.
CONST float EDGE_MARGIN = 9.5367431640625e-7f;  // 2^-20

/// Barycentrics of the second and third vertex, moved away from the triangle's edges.
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

/// Moves a finite point off the surface, to the side that the unit normal points to. `magnitude` bounds, per
/// coordinate, the terms that were summed to compute the point. These terms determine the rounding error; the sum
/// itself may be near 0. So the step scales with the scene. Waechter and Binder 2019 (Ray Tracing Gems, chapter 6) use
/// the point itself, and a fixed step near 0 that suits scenes of unit size. Error bounds as in Pharr, Jakob and
/// Humphreys 2016, section 3.9.
FN vec3 offset_ray(vec3 position, vec3 geometric_normal, vec3 magnitude) {
    PRECISE float ulps = OFFSET_ULPS * dot(abs(geometric_normal), magnitude) + OFFSET_LEAST_ULPS * max_component(magnitude);
    PRECISE vec3 moved = position + geometric_normal * (ulps * 1.1920929e-7f);
    return MUTANT(RAYS_NOT_OFFSET, moved, position);
}

SHARED_END

#endif
