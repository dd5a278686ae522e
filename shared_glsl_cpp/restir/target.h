// The resampling target p̂(y) = luminance(reflectance · radiance) · measure, per unit of uv measure of a light point y
// (light_point.h). It need not equal the integrand, but it must be positive wherever the integrand is. It uses Lambert
// plus GGX for every material. Its cosines have a floor that exceeds the rounding of the packed normals, so that
// rounding at a horizon cannot make it 0. Visibility is added in target_visibility.kernel.h.
#ifndef TARGET_H
#define TARGET_H

#include "bsdf/fresnel.h"
#include "bsdf/ggx.h"
#include "bsdf/normal_map.h"
#include "lights/light_point.h"

SHARED_BEGIN

CONST float TARGET_COS_MIN = 1.0e-3f;        // floor of cosines to the shading normal; octahedral error: below 1e-4
CONST float TARGET_COS_MIN_FACETS = 0.1f;    // with a microfacet normal map: the tangent facet also sends light
CONST float TARGET_ALPHA_MIN = 0.001f;       // narrower lobes are widened: octahedral rounding moves their peaks
CONST float TARGET_ALPHA_MIN_FACETS = 0.1f;  // with such a map, because the target lacks the tangent facet's lobes
CONST uint REUSE_SURFACE_VALID = 1u;
CONST uint REUSE_SURFACE_MAPPED = 2u;        // shaded with a normal map's normal
CONST uint REUSE_SURFACE_FACETS = 4u;        // shaded with a microfacet normal map

/// The surface at which the target is evaluated; unpack_reuse_surface makes it.
struct TargetSurface {
    vec3 position;
    vec3 geometric_normal;
    vec3 normal;
    vec3 specular_normal;  // equals `normal` unless the surface is shaded with a normal map's normal
    vec3 wo;
    vec3 diffuse;
    vec3 f0;
    float f90;
    float alpha;
    uint flags;
};

/// The GGX lobe: f cos_i.
FN vec3 target_specular(IN(TargetSurface) s, vec3 wi, float least) {
    float cos_i = clamp(dot(wi, s.specular_normal), least, 1.0f);
    float cos_o = clamp(dot(s.wo, s.specular_normal), least, 1.0f);
    vec3 sum = s.wo + wi;
    float squared = dot(sum, sum);
    if (!(squared > 1.0e-12f)) {
        return vec3(0.0f, 0.0f, 0.0f);
    }
    vec3 h = sum * inversesqrt(squared);
    float cos_h = clamp(dot(h, s.specular_normal), 0.0f, 1.0f);
    vec3 sine_h = cross(h, s.specular_normal);  // its length is used, because 1 - cos_h^2 would cancel in narrow lobes
    vec3 fresnel = fresnel_schlick(s.f0, vec3(s.f90, s.f90, s.f90), dot(s.wo, h));
    return fresnel * ggx_eval_of_cosines(cos_o, cos_i, cos_h, dot(sine_h, sine_h), s.alpha);
}

/// Approximates f cos_i for the unit direction wi: Lambert plus GGX, whatever the surface's own model.
FN vec3 target_reflectance(IN(TargetSurface) s, vec3 wi) {
    if (!(dot(wi, s.geometric_normal) > -TARGET_COS_MIN)) {
        return vec3(0.0f, 0.0f, 0.0f);
    }
    float least = (s.flags & REUSE_SURFACE_FACETS) != 0u ? TARGET_COS_MIN_FACETS : TARGET_COS_MIN;
    float cos_i = clamp(dot(wi, s.normal), least, 1.0f);
    vec3 sum = s.diffuse * (INV_PI * cos_i) + target_specular(s, wi, least);
    if ((s.flags & REUSE_SURFACE_MAPPED) != 0u) {
        vec3 below = reflect_off(s.geometric_normal, wi);
        if (dot(below, s.specular_normal) > 0.0f) {
            sum += target_specular(s, below, least);  // light that the lobe sends below the surface
        }
    }
    return sum;
}

/// p̂ of a light point; `reflectance` is f cos_i of its direction.
FN float target_of_reflectance(vec3 reflectance, IN(SeenLight) light) {
    return light.measure * luminance(reflectance * light.radiance);
}

/// p̂ without visibility.
FN float unoccluded_target(IN(TargetSurface) s, IN(SeenLight) light) {
    return target_of_reflectance(target_reflectance(s, light.direction), light);
}

SHARED_END

#endif
