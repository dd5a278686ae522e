// Probes of Fresnel, the microfacet models and the surface in its own frame.
#ifndef PROBES_BSDF_H
#define PROBES_BSDF_H

#include "probe.h"

SHARED_BEGIN

FN void probe_fresnel(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    float f0 = dielectric_f0(1.0f + 3.0f * p.u.x);
    put(o, f0, f0 + p.u.x);  // n - 1 keeps what 1 + 3u lost
    put_relative(o, dielectric_f0(2.0f + abs(p.number)));
    put3(o, fresnel_schlick(p.color, p.color_2, p.wo.z), 1.0f);
}

FN void probe_ggx_parts(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    put_relative(o, ggx_d(p.facet, p.alpha));
    put_relative(o, ggx_d(p.axis, p.alpha));
    put_relative(o, ggx_smith_length(p.wo, p.alpha));
    put_relative(o, ggx_g1(p.wo, p.alpha));
    put_relative(o, ggx_g2(p.wo, p.wi, p.alpha));
    float facing = max(dot(p.wo, p.facet), 1.0e-30f);
    float pdf = pdf_ggx_visible_normal(p.wo, p.facet, p.alpha);
    put(o, pdf,
        ggx_d(p.facet, p.alpha) / (p.wo.z + ggx_smith_length(p.wo, p.alpha)) * (facing + dot_scale(p.wo, p.facet)));
    put_relative(o, ggx_eval(p.wo, p.wi, p.facet, p.alpha));
    put_relative(o, ggx_stretch(p.facet.z, p.facet.x * p.facet.x + p.facet.y * p.facet.y, p.alpha * p.alpha));
    put_relative(o, ggx_eval_of_cosines(p.wo.z, p.wi.z, p.facet.z, p.facet.x * p.facet.x + p.facet.y * p.facet.y, p.alpha));
    put_relative(o, pdf_ggx_solid_angle(p.wo, p.facet, p.alpha));
    put_relative(o, ggx_weight(p.wo, p.wi, p.alpha));
}

/// How far h, drawn by sample_ggx_visible_normal, moves where the sum of unit vectors before its last step does by 1.
FN float probe_facet_scale(vec3 wo, vec3 h, float alpha, vec2 u) {
    vec3 w = normalize(vec3(wo.x * alpha, wo.y * alpha, wo.z));
    float height = (1.0f - u.y) * (1.0f + w.z);
    return 1.0f + alpha * h.z / max(height, 1.0e-12f);
}

FN void probe_ggx_sample(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    vec2 u = vec2(p.u.x, p.u.y);
    vec3 h = sample_ggx_visible_normal(p.wo, p.alpha, u);
    put3(o, h, probe_facet_scale(p.wo, h, p.alpha, u));
}

/// The exponent's size: 2^x errs by x times what its argument errs.
FN float probe_blinn_phong_scale(vec3 h, float alpha) {
    float cos2 = h.z * h.z;
    float log2_cos2 = cos2 < 0.5f ? -log2_poly(max(cos2, 1.0e-30f)) : 2.0f * (h.x * h.x + h.y * h.y);
    return 1.0f + min(log2_cos2 / (alpha * alpha), 200.0f);
}

FN void probe_blinn_phong_parts(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    put(o, blinn_phong_exponent(p.alpha), 2.0f / (p.alpha * p.alpha));
    float d_scale = probe_blinn_phong_scale(p.facet, p.alpha);
    float d = blinn_phong_d(p.facet, p.alpha);
    put(o, d, d * d_scale);
    float wide = blinn_phong_d(p.wo, p.alpha);
    put(o, wide, wide * probe_blinn_phong_scale(p.wo, p.alpha));
    // The rational fit meets 0 at a = 1.6, where only its terms of size 1/a are left.
    put(o, blinn_phong_lambda(p.wo, p.alpha), blinn_phong_lambda(p.wo, p.alpha) + 1.0f);
    put_relative(o, blinn_phong_g1(p.wo, p.alpha));
    put_relative(o, blinn_phong_g2(p.wo, p.wi, p.alpha));
    float value = blinn_phong_eval(p.wo, p.wi, p.facet, p.alpha);
    put(o, value, value * d_scale);
    float pdf = pdf_blinn_phong_solid_angle(p.wo.z, p.facet, p.alpha);
    put(o, pdf, pdf * d_scale);
    vec3 h = sample_blinn_phong_normal(p.alpha, vec2(p.u.x, p.u.y));
    put3(o, h, length(vec2(h.x, h.y)));
    o.scale[o.value_count - 1u] = h.z;
}

FN BsdfParameters probe_parameters(IN(ProbeInput) p) {
    uint kind = p.words.x & 3u;
    float metallic = kind == 0u ? 0.0f : (kind == 1u ? 1.0f : p.u.w);
    float roughness = (p.words.y & 2u) != 0u ? p.u.w : p.alpha;
    return bsdf_parameters(p.color, metallic, roughness, 0.04f, p.u.z, 2.0f * p.color_2,
                           (p.words.y & 1u) != 0u ? BRDF_BLINN_PHONG : BRDF_GGX);
}

/// Mostly everything, else any set of bits.
FN uint probe_features(IN(ProbeInput) p) {
    return p.words.z % 4u == 0u ? p.words.w : 0xffffffffu;
}

FN void probe_bsdf_parameters(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    BsdfParameters b = probe_parameters(p);
    uint features = probe_features(p);
    put3(o, b.diffuse, 1.0f);
    put3(o, b.f0, 1.0f);
    put3(o, b.f90, 1.0f);
    put_bits(o, floatBitsToUint(b.alpha));
    put_bits(o, b.model);
    put_bits(o, bsdf_is_mirror(b, features) ? 1u : 0u);
    put_bits(o, bsdf_is_blinn_phong(b, features) ? 1u : 0u);
    put_bits(o, bsdf_is_purely_delta(b, features) ? 1u : 0u);
    put_bits(o, bsdf_may_be_specular(features) ? 1u : 0u);
    put(o, bsdf_specular_probability(b, p.wo, features), 1.0f);
    BsdfSample none = bsdf_null_sample();
    put_same3(o, none.direction);
    put_same3(o, none.weight);
    put_bits(o, floatBitsToUint(none.pdf) | none.delta);
    BsdfSample mirrored = bsdf_sample_mirror(b, p.wo, 0.5f);
    put(o, mirrored.direction.z + mirrored.weight.x, 4.0f);
}

/// Of eval and pdf at unmoved directions: the half vector is then exact but for its length.
FN float probe_eval_scale(IN(BsdfParameters) b, vec3 wo, vec3 wi, uint features) {
    vec3 sum = wo + wi;
    vec3 h = sum / max(length(sum), 1.0e-20f);
    return bsdf_is_blinn_phong(b, features) ? probe_blinn_phong_scale(h, clamp(b.alpha, ALPHA_MIRROR, 1.0f)) : 1.0f;
}

FN void probe_bsdf_eval(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    BsdfParameters b = probe_parameters(p);
    uint features = probe_features(p);
    float scale = probe_eval_scale(b, p.wo, p.wi, features);
    BsdfValue v = bsdf_eval_pdf_local(b, p.wo, p.wi, features);
    // 1 - F may cancel, so that the diffuse part counts whole.
    float size = (max_component(v.value) + max_component(b.diffuse) * p.wi.z) * scale;
    put3(o, v.value, size);
    put3(o, bsdf_eval_local(b, p.wo, p.wi, features), size);
    // Its lobes are weighed by probabilities, which err absolutely, but are LOBE_MIN at least.
    put(o, v.pdf, v.pdf * scale);
    put(o, bsdf_pdf_local(b, p.wo, p.wi, features), v.pdf * scale);
    BsdfValue microfacets = microfacet_eval_pdf(b, p.wo, p.wi, features);
    put3(o, microfacets.value, max_component(microfacets.value) * scale);
    put(o, microfacets.pdf, microfacets.pdf * scale);
}

/// d ln D / d h: GGX falls as a power of the tangent, Blinn-Phong exponentially, down to its floor.
FN float probe_slope(vec3 h, float alpha, bool blinn_phong) {
    float s2 = h.x * h.x + h.y * h.y;
    float a2 = alpha * alpha;
    float s = sqrt(s2) + 1.0e-6f;
    if (blinn_phong) {
        return s2 < 70.0f * a2 ? 2.0f * s / a2 : 1.0f;
    }
    return 4.0f * s / (a2 + s2);
}

/// Of eval and pdf where directions moved by 1: h then moves by 1/|wo + wi|.
FN float probe_moved_scale(IN(BsdfParameters) b, vec3 wo, vec3 wi, uint features) {
    if (!(wo.z > COS_MIN && wi.z > COS_MIN)) {
        return 1.0f;
    }
    float alpha = clamp(b.alpha, ALPHA_MIRROR, 1.0f);
    vec3 sum = wo + wi;
    float inverse = 1.0f / length(sum);
    float slope =
        bsdf_is_mirror(b, features) ? 1.0f : probe_slope(sum * inverse, alpha, bsdf_is_blinn_phong(b, features));
    return probe_eval_scale(b, wo, wi, features) + (1.0f + slope) * inverse + 1.0f / wo.z + 1.0f / wi.z;
}

FN void probe_bsdf_sample(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    BsdfParameters b = probe_parameters(p);
    uint features = probe_features(p);
    vec2 u = vec2(p.u.x, p.u.y);
    bool specular = p.u.z < bsdf_specular_probability(b, p.wo, features);
    BsdfSample s = bsdf_sample_local(b, p.wo, p.u.z, u, features);
    put_path(o, specular);
    put_path(o, s.pdf > 0.0f);
    put_bits(o, s.delta);
    if (!(s.pdf > 0.0f)) {
        return;
    }
    float alpha = clamp(b.alpha, ALPHA_MIRROR, 1.0f);
    float moved = 1.0f;
    if (specular && s.delta == 0u && !bsdf_is_blinn_phong(b, features)) {
        moved = probe_facet_scale(p.wo, sample_microfacet_normal(b, p.wo, u, features | FEATURE_GGX), alpha, u);
    }
    put3(o, s.direction, moved);
    float scale = s.delta != 0u ? 1.0f : moved * probe_moved_scale(b, p.wo, s.direction, features);
    if (!put_comparable(o, scale)) {
        return;
    }
    put3(o, s.weight, (1.0f + max_component(s.weight)) * scale);
    put(o, s.pdf, s.pdf * scale);
}

SHARED_END

// See probe_list.h.
#define BSDF_PROBES(X)                                                                                                 \
    X(fresnel, 12, 0, "a division, squared")                                                                           \
    X(ggx_parts, 32, 0, "a squared division, sqrt and a division")                                                     \
    X(ggx_sample, 32, 0, "normalize, sqrt, sin_cos, normalize")                                                        \
    X(blinn_phong_parts, 32, 0, "two divisions; sqrt; the exponent's size is in the scale")                            \
    X(bsdf_parameters, 16, 0, "mix; a division")                                                                       \
    X(bsdf_eval, 96, 20, "half vector by sqrt and division, then the lobes'")                                          \
    X(bsdf_sample, 96, 200, "the facet's, a reflection, then eval's")

#endif
