// The isotropic GGX microfacet distribution with Smith masking. All directions are local, unit, normal = +z, and leave
// the surface; alpha = roughness^2 in [1e-4, 1]; cosines of wo and wi are positive.
#ifndef GGX_H
#define GGX_H

#include "numbers/elementary.h"

SHARED_BEGIN

/// cos^2 alpha^2 + sin^2 of a facet normal. This form has no cancellation.
FN float ggx_stretch(float cos_h, float sin2_h, float a2) {
    return cos_h * cos_h * a2 + sin2_h;
}

/// D(h), per steradian; Walter et al. 2007, eq. 33, as alpha^2 / (pi (cos^2 alpha^2 + sin^2)^2).
FN float ggx_d(vec3 h, float alpha) {
    float a2 = alpha * alpha;
    float t = ggx_stretch(h.z, h.x * h.x + h.y * h.y, a2);
    t = MUTANT(GGX_D_CANCELS, t, h.z * h.z * (a2 - 1.0f) + 1.0f);
    float r = alpha / t;
    return h.z > 0.0f ? INV_PI * r * r : 0.0f;
}

/// cos(theta) (1 + 2 Lambda); Heitz 2014, eq. 72, times the cosine.
FN float ggx_smith_length(vec3 w, float alpha) {
    return sqrt(w.z * w.z + alpha * alpha * (w.x * w.x + w.y * w.y));
}

/// Smith masking of one direction, in (0, 1]; Heitz 2014, eq. 43.
FN float ggx_g1(vec3 w, float alpha) {
    return 2.0f * w.z / (w.z + ggx_smith_length(w, alpha));
}

/// Height-correlated masking and shadowing; Heitz 2014, eq. 99.
FN float ggx_g2(vec3 wo, vec3 wi, float alpha) {
    float o = wi.z * ggx_smith_length(wo, alpha);
    float i = wo.z * ggx_smith_length(wi, alpha);
    return 2.0f * wo.z * wi.z / (o + i);
}

/// Samples a facet normal visible from wo (Dupuy and Benyoub 2023). The sine of the spherical cap comes from 1 - z,
/// which does not cancel.
FN vec3 sample_ggx_visible_normal(vec3 wo, float alpha, vec2 u) {
    vec3 w = normalize(vec3(wo.x * alpha, wo.y * alpha, wo.z));
    float one_minus_z = u.y * (1.0f + w.z);
    float one_plus_z = (1.0f - u.y) * (1.0f + w.z) + (w.x * w.x + w.y * w.y) / (1.0f + w.z);
    float sine = sqrt(one_minus_z * one_plus_z);
    float s;
    float c;
    sin_cos((2.0f * u.x - 1.0f) * PI, s, c);
    vec3 h = vec3(sine * c + w.x, sine * s + w.y, (1.0f - u.y) * (1.0f + w.z));
    return normalize(vec3(h.x * alpha, h.y * alpha, h.z));
}

/// Density of visible normals, per steradian of h: Heitz 2014, eq. 16. Its cosine cancels with the one in G1.
FN float pdf_ggx_visible_normal(vec3 wo, vec3 h, float alpha) {
    return 2.0f * ggx_d(h, alpha) * max(dot(wo, h), 0.0f) / (wo.z + ggx_smith_length(wo, alpha));
}

/// D G2 / (4 cos_o cos_i) |cos_i|: the reflection before its Fresnel factor. h is the unit half vector.
FN float ggx_eval(vec3 wo, vec3 wi, vec3 h, float alpha) {
    float o = wi.z * ggx_smith_length(wo, alpha);
    float i = wo.z * ggx_smith_length(wi, alpha);
    return 0.5f * ggx_d(h, alpha) * (wi.z / (o + i));
}

/// ggx_eval from cosines to the normal and the squared sine of the half vector. The caller may have raised the cosines
/// to a floor, so that no directions have them. For cosines of real directions this is ggx_eval up to rounding.
FN float ggx_eval_of_cosines(float cos_o, float cos_i, float cos_h, float sin2_h, float alpha) {
    float a2 = alpha * alpha;
    float t = ggx_stretch(cos_h, sin2_h, a2);
    float d = INV_PI * a2 / (t * t);
    float o = cos_i * sqrt(cos_o * cos_o * (1.0f - a2) + a2);
    float i = cos_o * sqrt(cos_i * cos_i * (1.0f - a2) + a2);
    return 0.5f * d * cos_i / (o + i);
}

/// Density of the reflected direction, per steradian of wi: D_v / (4 o·h) = D G1 / (4 cos_o).
FN float pdf_ggx_solid_angle(vec3 wo, vec3 h, float alpha) {
    float pdf = 0.5f * ggx_d(h, alpha) / (wo.z + ggx_smith_length(wo, alpha));
    pdf = MUTANT(NO_HALF_VECTOR_JACOBIAN, pdf, pdf_ggx_visible_normal(wo, h, alpha));
    return MUTANT(ALL_FACETS_FOR_VISIBLE, pdf, ggx_d(h, alpha) * h.z / (4.0f * dot(wo, h)));
}

/// ggx_eval / pdf_ggx_solid_angle = G2 / G1, in [0, 1].
FN float ggx_weight(vec3 wo, vec3 wi, float alpha) {
    float o = ggx_smith_length(wo, alpha);
    float i = ggx_smith_length(wi, alpha);
    return min(wi.z * (wo.z + o) / (wi.z * o + wo.z * i), 1.0f);
}

SHARED_END

#endif
