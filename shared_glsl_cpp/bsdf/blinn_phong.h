// The normalised Blinn-Phong microfacet distribution, D = (n + 2)/(2 pi) cos^n, n = 2/alpha^2 - 2 (Walter et al. 2007,
// eq. 30). Conventions as in ggx.h. At alpha = 1 it is GGX; toward alpha = 0 it is Beckmann.
#ifndef BLINN_PHONG_H
#define BLINN_PHONG_H

#include "numbers/elementary.h"

SHARED_BEGIN

// Floor of log2 of the power. Far below the peak the exact value underflows to 0. A sampled direction that rounding
// has moved there would then have density 0.
CONST float BLINN_PHONG_LEAST_LOG2 = -86.0f;

FN float blinn_phong_exponent(float alpha) {
    return 2.0f / (alpha * alpha) - 2.0f;
}

/// D(h), per steradian. cos^n is computed as 2^(n/2 log2(1 - sin^2)), because pow is too inexact for large n.
FN float blinn_phong_d(vec3 h, float alpha) {
    float n = blinn_phong_exponent(alpha);
    float cos2 = h.z * h.z;
    float log2_cos2 =
        cos2 < 0.5f ? log2_poly(max(cos2, 1.0e-30f)) : log1p_poly(-min(h.x * h.x + h.y * h.y, 0.75f)) * LOG2_E;
    log2_cos2 = MUTANT(BLINN_PHONG_POW, log2_cos2, log2_poly(max(cos2, 1.0e-30f)));
    float power = exp2_poly(clamp(0.5f * n * log2_cos2, BLINN_PHONG_LEAST_LOG2, 0.0f));
    return h.z > 0.0f ? (n + 2.0f) * (0.5f * INV_PI) * power : 0.0f;
}

/// Smith's Lambda. The slopes of this distribution are Student-t with n + 2 degrees of freedom (Ribardière et al.
/// 2017). It is GGX at n = 0 (Heitz 2014, eq. 72) and Beckmann at infinity (rational fit: Walter et al. 2007, eq. 27).
/// Between the two, Lambda is a mix that is exact toward grazing; G1 stays within 0.01 of the exact value.
FN float blinn_phong_lambda(vec3 w, float alpha) {
    float t = alpha * alpha;
    float sin2 = w.x * w.x + w.y * w.y;
    float a = min(w.z / (alpha * sqrt(max(sin2, 1.0e-30f))), 1.6f);
    float beckmann = max((1.0f + a * (-1.259f + a * 0.396f)) / (a * (3.535f + a * 2.181f)), 0.0f);
    float r = t * sin2 / (w.z * w.z);
    float ggx = 0.5f * r / (1.0f + sqrt(1.0f + r));
    float share = t * (0.453f + t * (0.391f + t * (-0.139f + t * 0.295f)));
    return beckmann + (ggx - beckmann) * share;
}

/// Smith masking of one direction, in (0, 1].
FN float blinn_phong_g1(vec3 w, float alpha) {
    return 1.0f / (1.0f + blinn_phong_lambda(w, alpha));
}

/// Height-correlated masking and shadowing; Heitz 2014, eq. 99.
FN float blinn_phong_g2(vec3 wo, vec3 wi, float alpha) {
    return 1.0f / (1.0f + blinn_phong_lambda(wo, alpha) + blinn_phong_lambda(wi, alpha));
}

/// A facet normal with density D(h) cos: cos = (1 - u)^(1/(n + 2)), with 1/(n + 2) = alpha^2 / 2.
FN vec3 sample_blinn_phong_normal(float alpha, vec2 u) {
    float x = alpha * alpha * log1p_poly(-min(u.y, 0.99999994f));  // ln cos^2
    float series = 1.0f + x * (0.5f + x * (0.16666667f + x * (0.041666668f + x * (0.0083333333f + x * 0.0013888889f))));
    float sin2 = x > -0.3f ? -x * series : 1.0f - exp2_poly(x * LOG2_E);
    float s;
    float c;
    sin_cos((2.0f * u.x - 1.0f) * PI, s, c);
    float sine = sqrt(sin2);
    return vec3(sine * c, sine * s, exp2_poly(0.5f * x * LOG2_E));
}

/// D G2 / (4 cos_o cos_i) |cos_i|: the reflection before its Fresnel factor. h is the unit half vector.
FN float blinn_phong_eval(vec3 wo, vec3 wi, vec3 h, float alpha) {
    return blinn_phong_d(h, alpha) * blinn_phong_g2(wo, wi, alpha) / (4.0f * wo.z);
}

/// Density of the reflected direction, per steradian of wi: D(h) cos_h / (4 o·h).
FN float pdf_blinn_phong_solid_angle(float o_dot_h, vec3 h, float alpha) {
    return blinn_phong_d(h, alpha) * h.z / MUTANT(NO_HALF_VECTOR_JACOBIAN_BLINN_PHONG, 4.0f * o_dot_h, 1.0f);
}

SHARED_END

#endif
