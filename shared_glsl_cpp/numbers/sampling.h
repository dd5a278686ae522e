// Warps of the unit square, in local frames with z up. Pdfs are per solid angle. Defined for u in [0, 1]^2.
#ifndef SAMPLING_H
#define SAMPLING_H

#include "numbers/elementary.h"

SHARED_BEGIN

/// A uniform point on the unit disk by the concentric map, which preserves strata (Shirley and Chiu 1997). `radius` is
/// signed.
FN vec2 sample_disk_concentric(vec2 u, OUT(float) radius) {
    float a = 2.0f * u.x - 1.0f;
    float b = 2.0f * u.y - 1.0f;
    bool wide = abs(a) > abs(b);
    radius = wide ? a : b;
    float ratio = radius == 0.0f ? 0.0f : (wide ? b : a) / radius;
    float s;
    float c;
    sin_cos_octant(QUARTER_PI * ratio, s, c);  // angle from the nearer axis
    float along = radius * c;
    float across = radius * s;
    return vec2(wide ? along : across, wide ? across : along);
}

FN vec2 sample_disk_concentric(vec2 u) {
    float radius;
    return sample_disk_concentric(u, radius);
}

/// Malley's method: a uniform point of the disk, projected up to the hemisphere.
FN vec3 sample_cosine_hemisphere(vec2 u) {
    float radius;
    vec2 disk = sample_disk_concentric(u, radius);
    return vec3(disk.x, disk.y, safe_sqrt((1.0f - radius) * (1.0f + radius)));
}

FN float pdf_cosine_hemisphere_solid_angle(float cos_theta) {
    return MUTANT(UNIFORM_PDF, max(cos_theta, 0.0f), 0.5f) * INV_PI;
}

FN vec3 sample_uniform_hemisphere(vec2 u) {
    float z = 1.0f - u.x;
    float radius = safe_sqrt(u.x * (1.0f + z));
    float s;
    float c;
    sin_cos(2.0f * PI * u.y, s, c);
    return vec3(radius * c, radius * s, z);
}

FN float pdf_uniform_hemisphere_solid_angle() {
    return 0.5f * INV_PI;
}

FN vec3 sample_uniform_sphere(vec2 u) {
    float z = 1.0f - 2.0f * u.x;
    float radius = 2.0f * safe_sqrt(u.x * (1.0f - u.x));
    float s;
    float c;
    sin_cos(2.0f * PI * u.y, s, c);
    return vec3(radius * c, radius * s, z);
}

FN float pdf_uniform_sphere_solid_angle() {
    return 0.25f * INV_PI;
}

SHARED_END

#endif
