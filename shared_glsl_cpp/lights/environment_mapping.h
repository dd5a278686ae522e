// Equirectangular maps. u = 1/2 is -Z, and u grows toward +X; v = 0 is +Y. `rotation` is the cosine and sine of the
// map's rotation about +Y, counter-clockwise seen from above.
#ifndef ENVIRONMENT_MAPPING_H
#define ENVIRONMENT_MAPPING_H

#include "numbers/elementary.h"

SHARED_BEGIN

/// u in [0, 1), v in [0, 1]. The direction may have any length.
FN vec2 environment_uv(vec3 direction, vec2 rotation) {
    float x = rotation.x * direction.x - rotation.y * direction.z;
    float z = rotation.y * direction.x + rotation.x * direction.z;
    float u = 0.5f + arctan2(x, -z) * (0.5f * INV_PI);
    float v = arctan2(sqrt(x * x + z * z), direction.y) * INV_PI;
    return vec2(u < 1.0f ? u : 0.0f, min(v, 1.0f));
}

/// The unit direction that environment_uv maps to uv.
FN vec3 environment_direction(vec2 uv, vec2 rotation) {
    float sin_phi;
    float cos_phi;
    sin_cos(2.0f * PI * (uv.x - 0.5f), sin_phi, cos_phi);
    float sin_theta;
    float cos_theta;
    sin_cos(PI * uv.y, sin_theta, cos_theta);
    float x = sin_theta * sin_phi;
    float z = -sin_theta * cos_phi;
    return vec3(rotation.x * x + rotation.y * z, cos_theta, rotation.x * z - rotation.y * x);
}

/// Pdf of a direction in a texel of probability texel_pmf, uniform in (u, v) within the texel; 0 at the poles.
FN float pdf_environment_solid_angle(float texel_pmf, uvec2 size, float sin_theta) {
    if (!(sin_theta > 0.0f)) {
        return 0.0f;
    }
    return texel_pmf * (float(size.x) * float(size.y)) * (0.5f * INV_PI * INV_PI) / sin_theta;
}

SHARED_END

#endif
