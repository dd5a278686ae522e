// Fresnel reflectance of a smooth facet.
#ifndef FRESNEL_H
#define FRESNEL_H

#include "language/compat.h"

SHARED_BEGIN

/// Reflectance at normal incidence of a dielectric in air. An index of 0 means an infinite index (KHR_materials_ior),
/// whose reflectance is 1.
FN float dielectric_f0(float ior) {
    float n = clamp(ior, 0.0f, 1.0e18f);
    float r = (n - 1.0f) / (n + 1.0f);
    return r * r;
}

/// Schlick 1994: from f0 at normal incidence to f90 at grazing incidence.
FN vec3 fresnel_schlick(vec3 f0, vec3 f90, float cos_theta) {
    float m = clamp(1.0f - cos_theta, 0.0f, 1.0f);
    float m2 = m * m;
    return f0 + (f90 - f0) * (m2 * m2 * m);
}

SHARED_END

#endif
