// Normals adapted to the direction they are seen from. World space, unit vectors.
#ifndef SHADING_NORMAL_H
#define SHADING_NORMAL_H

#include "numbers/elementary.h"

SHARED_BEGIN

CONST float BENT_COS = 1.0e-3f;    // smallest cosine of wo to the normal it is shaded with
CONST float MAPPED_COS = 1.0e-2f;  // smallest cosine of a mapped normal to the surface's normal
CONST float TANGENT_SINE = 1.0e-4f;  // smallest sine of a tangent to the normal; below it the tangent is unusable

/// The unit vector nearest to v whose cosine to the unit `axis` is at least `cos_min`; `axis` itself where v opposes
/// it.
FN vec3 bend_toward(vec3 v, vec3 axis, float cos_min) {
    float c = dot(v, axis);
    if (c >= cos_min) {
        return v;
    }
    vec3 across = v - c * axis;
    float across2 = dot(across, across);
    if (!(across2 > 1.0e-12f)) {
        return axis;
    }
    return normalize(cos_min * axis + (safe_sqrt(1.0f - cos_min * cos_min) * inversesqrt(across2)) * across);
}

/// The normal to shade with: ns, rotated just far enough that wo is above its horizon. At the silhouette of a coarse
/// smooth mesh wo can see the triangle and yet be below the interpolated normal's horizon; without the rotation such
/// pixels are black. ng is on wo's side.
FN vec3 bent_normal(vec3 ns, vec3 ng, vec3 wo) {
    vec3 n = bend_toward(ns, wo, BENT_COS);
    return dot(n, ng) > 0.0f ? n : ng;
}

SHARED_END

#endif
