// Shading with a normal map's normal, as glTF defines it, without its two artefacts: reflections that point below the
// surface, and an abrupt terminator (docs/integrand.md, "Normal maps"; docs/decisions/0020). World space, unit
// vectors. ng is the triangle's normal on wo's side.
#ifndef NORMAL_MAP_H
#define NORMAL_MAP_H

#include "bsdf/shading_normal.h"

SHARED_BEGIN

CONST float REFLECTION_COS = 0.1f;       // least cosine to ng of a mirror reflection about the specular normal,
CONST float REFLECTION_COS_SHARE = 0.9f; // or this share of the cosine of wo, if that is less
CONST float TERMINATOR_RANGE = 0.25f;  // the largest cosine to ng below which light fades

/// The normal q of the integrand's equation 1: n, rotated toward ng until the mirror direction of wo is above the
/// surface. Cycles bends normals for the same purpose. Between ng and n the mirror direction's cosine to ng is r
/// cos(2a - phi), where a is the angle from ng. So the largest admissible a has a closed form.
FN vec3 specular_normal(vec3 n, vec3 ng, vec3 wo) {
    float cos_o = dot(wo, ng);
    float cos_n = dot(n, ng);
    float least = min(REFLECTION_COS_SHARE * cos_o, REFLECTION_COS);
    if (MUTANT(REFLECTION_NOT_KEPT, 2.0f * dot(wo, n) * cos_n - cos_o >= least, true)) {
        return n;
    }
    vec3 across = n - cos_n * ng;
    float across2 = dot(across, across);
    if (!(across2 > 1.0e-12f)) {
        return ng;
    }
    vec3 e = across * inversesqrt(across2);
    // In the plane of ng and e, wo is r (cos phi, sin phi). The angle 2a is phi + acos(least / r).
    float along = dot(wo, e);
    float r2 = cos_o * cos_o + along * along;
    if (!(r2 > 0.0f)) {
        return ng;  // wo lies in the surface, perpendicular to the tilt
    }
    float rest = safe_sqrt(r2 - least * least);
    float cos_2a = (cos_o * least - along * rest) / r2;
    float sin_2a = (along * least + cos_o * rest) / r2;
    return normalize((1.0f + cos_2a) * ng + sin_2a * e);
}

/// S of equations 2 and 3: 1 well above the surface, falling to 0 at its horizon. The range of the fall is 0 for a
/// normal that does not tilt, and grows with the tilt and with `width`. After Chiang, Li and Burley 2019, whose factor
/// acts on all directions.
FN float terminator_factor(vec3 n, vec3 ng, vec3 wi, float width) {
    vec3 sine = cross(n, ng);
    float range = width * min(TERMINATOR_RANGE, length(sine)) * dot(wi, n);
    float cos_i = dot(wi, ng);
    if (!(cos_i < range)) {
        return 1.0f;
    }
    float x = max(cos_i, 0.0f) / range;
    return MUTANT(HARD_TERMINATOR, x + x * x * (1.0f - x), 1.0f);
}

/// Reflection in the surface: how light leaves that a lobe sent below the surface. It is its own inverse.
FN vec3 reflect_off(vec3 ng, vec3 w) { return w - 2.0f * dot(w, ng) * ng; }

SHARED_END

#endif
