// glTF 2.0's metallic-roughness surface as one sample / eval / pdf triple over either microfacet model. Reflection
// only:
//   f = diffuse/pi (1 - F) + F D G2 / (4 cos_o cos_i),  F = F(o·h)   (glTF 2.0, appendix B.3; KHR_materials_specular)
// Directions are local: unit, shading normal = +z, leaving the surface. `features` are the bits of scene_features.h
// that may be needed. The code of a bit that is off is dropped; surfaces that do not need it get the same result.
#ifndef BSDF_H
#define BSDF_H

#include "bsdf/blinn_phong.h"
#include "bsdf/fresnel.h"
#include "bsdf/ggx.h"
#include "bsdf/lobes.h"
#include "numbers/sampling.h"
#include "language/scene_features.h"
#include "language/scene_types.h"

SHARED_BEGIN

CONST float ALPHA_MIRROR = 1.0e-4f;  // an alpha below this is a perfect mirror
CONST float COS_MIN = 1.0e-7f;       // a cosine up to this counts as below the horizon, in sample, eval and pdf alike
CONST float LOBE_MIN = 0.1f;         // the smallest selection probability of a lobe that can reflect

struct BsdfParameters {
    vec3 diffuse;  // base color · (1 - metallic)
    vec3 f0;
    vec3 f90;
    float alpha;  // roughness^2
    uint model;   // BRDF_...
};

struct BsdfSample {
    vec3 direction;  // unit; undefined where pdf is 0
    vec3 weight;     // f cos / pdf
    float pdf;       // per steradian; 0 for a null sample; the discrete probability for a delta lobe
    uint delta;      // 1: a perfect mirror
    uint lobe;       // LOBE_… | FACET_…, for path records
};

/// f cos and the pdf of one pair of directions.
struct BsdfValue {
    vec3 value;
    float pdf;
};

/// `f0_dielectric`: see dielectric_f0. `specular` and `specular_color`: see KHR_materials_specular.
FN BsdfParameters bsdf_parameters(vec3 base_color, float metallic, float roughness, float f0_dielectric, float specular,
                                  vec3 specular_color, uint model) {
    BsdfParameters p;
    float m = clamp(metallic, 0.0f, 1.0f);
    float r = clamp(roughness, 0.0f, 1.0f);
    vec3 f0 = min(f0_dielectric * specular_color, vec3(1.0f, 1.0f, 1.0f)) * specular;
    p.diffuse = base_color * (1.0f - m);
    p.f0 = mix(f0, base_color, m);
    p.f90 = mix(vec3(specular, specular, specular), vec3(1.0f, 1.0f, 1.0f), m);
    p.alpha = r * r;
    p.model = model;
    return p;
}

/// Whether any surface of the scene may reflect specularly. A scene that needs no microfacet model is all diffuse.
FN bool bsdf_may_be_specular(uint features) {
    return (features & (FEATURE_GGX | FEATURE_BLINN_PHONG)) != 0u;
}

FN bool bsdf_is_mirror(IN(BsdfParameters) p, uint features) {
    return (features & FEATURE_MIRRORS) != 0u && p.alpha < ALPHA_MIRROR;
}

FN bool bsdf_is_blinn_phong(IN(BsdfParameters) p, uint features) {
    return (features & FEATURE_BLINN_PHONG) != 0u && ((features & FEATURE_GGX) == 0u || p.model == BRDF_BLINN_PHONG);
}

/// Selection probability of the specular lobe, seen from wo; -1 where the surface reflects nothing.
FN float bsdf_specular_probability(IN(BsdfParameters) p, vec3 wo, uint features) {
    bool has_diffuse = max_component(p.diffuse) > 0.0f;
    if (!bsdf_may_be_specular(features)) {
        return has_diffuse ? 0.0f : -1.0f;
    }
    bool has_specular = max(max_component(p.f0), max_component(p.f90)) > 0.0f;
    float s = luminance(fresnel_schlick(p.f0, p.f90, wo.z));
    float d = luminance(p.diffuse) * (1.0f - clamp(s, 0.0f, 1.0f));
    float mixed = clamp(s / max(s + d, 1.0e-20f), LOBE_MIN, 1.0f - LOBE_MIN);
    float single = has_specular ? 1.0f : (has_diffuse ? 0.0f : -1.0f);
    return has_diffuse && has_specular ? mixed : single;
}

/// Whether the surface reflects as a mirror only. Light sampling finds nothing for such a surface.
FN bool bsdf_is_purely_delta(IN(BsdfParameters) p, uint features) {
    return bsdf_is_mirror(p, features) && !(max_component(p.diffuse) > 0.0f);
}

/// The microfacet lobe that is not a mirror: f cos_i = F D G2 / (4 cos_o), and its pdf. Both directions are above the
/// horizon.
FN BsdfValue microfacet_eval_pdf(IN(BsdfParameters) p, vec3 wo, vec3 wi, vec3 h, float o_dot_h, vec3 fresnel, uint features) {
    BsdfValue r;
    r.value = vec3(0.0f, 0.0f, 0.0f);
    r.pdf = 0.0f;
    float alpha = clamp(p.alpha, ALPHA_MIRROR, 1.0f);
    if (bsdf_is_blinn_phong(p, features)) {
        r.value = fresnel * blinn_phong_eval(wo, wi, h, alpha);
        r.pdf = pdf_blinn_phong_solid_angle(o_dot_h, h, alpha);
    } else if ((features & FEATURE_GGX) != 0u) {
        r.value = fresnel * ggx_eval(wo, wi, h, alpha);
        r.pdf = pdf_ggx_solid_angle(wo, h, alpha);
    }
    return r;
}

/// The same for any two directions.
FN BsdfValue microfacet_eval_pdf(IN(BsdfParameters) p, vec3 wo, vec3 wi, uint features) {
    BsdfValue r;
    r.value = vec3(0.0f, 0.0f, 0.0f);
    r.pdf = 0.0f;
    if (!(wo.z > COS_MIN && wi.z > COS_MIN)) {
        return r;
    }
    vec3 sum = wo + wi;
    float sum_length = length(sum);
    float o_dot_h = 0.5f * sum_length;
    return microfacet_eval_pdf(p, wo, wi, sum / sum_length, o_dot_h, fresnel_schlick(p.f0, p.f90, o_dot_h), features);
}

/// f cos_i and pdf of the lobes that are not delta. `p_specular` is bsdf_specular_probability of wo.
FN BsdfValue bsdf_eval_pdf_local(IN(BsdfParameters) p, vec3 wo, float p_specular, vec3 wi, uint features) {
    BsdfValue r;
    r.value = vec3(0.0f, 0.0f, 0.0f);
    r.pdf = 0.0f;
    if (!(wo.z > COS_MIN && wi.z > COS_MIN) || p_specular < 0.0f) {
        return r;
    }
    if (!bsdf_may_be_specular(features) || !(p_specular > 0.0f)) {  // diffuse only: f0 and f90 are 0
        r.value = p.diffuse * (INV_PI * MUTANT(DROP_COSINE, wi.z, 1.0f));
        r.pdf = pdf_cosine_hemisphere_solid_angle(wi.z);
        return r;
    }
    // |wo + wi| = 2 o·h. It is at least COS_MIN, because both directions are above the horizon.
    vec3 sum = wo + wi;
    float sum_length = length(sum);
    vec3 h = sum / sum_length;
    float o_dot_h = 0.5f * sum_length;
    vec3 fresnel = fresnel_schlick(p.f0, p.f90, o_dot_h);
    r.value = p.diffuse * (vec3(1.0f, 1.0f, 1.0f) - fresnel) * (INV_PI * wi.z);
    r.pdf = (1.0f - p_specular) * pdf_cosine_hemisphere_solid_angle(wi.z);
    if (!bsdf_is_mirror(p, features)) {
        BsdfValue microfacets = microfacet_eval_pdf(p, wo, wi, h, o_dot_h, fresnel, features);
        r.value += microfacets.value;
        r.pdf += p_specular * microfacets.pdf;
    }
    return r;
}

FN BsdfValue bsdf_eval_pdf_local(IN(BsdfParameters) p, vec3 wo, vec3 wi, uint features) {
    return bsdf_eval_pdf_local(p, wo, bsdf_specular_probability(p, wo, features), wi, features);
}

/// f |cos_i|, without delta lobes.
FN vec3 bsdf_eval_local(IN(BsdfParameters) p, vec3 wo, vec3 wi, uint features) {
    BsdfValue r = bsdf_eval_pdf_local(p, wo, wi, features);
    return r.value;
}

/// Density of wi per steradian, without delta lobes; integrates to 1 - P(null sample) - P(delta).
FN float bsdf_pdf_local(IN(BsdfParameters) p, vec3 wo, vec3 wi, uint features) {
    BsdfValue r = bsdf_eval_pdf_local(p, wo, wi, features);
    return r.pdf;
}

FN BsdfSample bsdf_null_sample() {
    BsdfSample s;
    s.direction = vec3(0.0f, 0.0f, 1.0f);
    s.weight = vec3(0.0f, 0.0f, 0.0f);
    s.pdf = 0.0f;
    s.delta = 0u;
    s.lobe = LOBE_NONE;
    return s;
}

FN BsdfSample bsdf_sample_mirror(IN(BsdfParameters) p, vec3 wo, float p_specular) {
    BsdfSample s;
    s.direction = vec3(-wo.x, -wo.y, wo.z);
    s.weight = fresnel_schlick(p.f0, p.f90, wo.z) / p_specular;
    s.pdf = p_specular;
    s.delta = 1u;
    s.lobe = LOBE_MIRROR;
    return s;
}

/// Normal of the microfacet off which the specular lobe reflects wo.
FN vec3 sample_microfacet_normal(IN(BsdfParameters) p, vec3 wo, vec2 u, uint features) {
    float alpha = clamp(p.alpha, ALPHA_MIRROR, 1.0f);
    if (bsdf_is_blinn_phong(p, features)) {
        return sample_blinn_phong_normal(alpha, u);
    }
    if ((features & FEATURE_GGX) != 0u) {
        return sample_ggx_visible_normal(wo, alpha, u);
    }
    return vec3(0.0f, 0.0f, 0.0f);
}

/// Samples a direction from one of the lobes. A facet that reflects below the horizon gives a null sample; there is no
/// retry. `p_specular` is bsdf_specular_probability of wo.
FN BsdfSample bsdf_sample_local(IN(BsdfParameters) p, vec3 wo, float p_specular, float u_lobe, vec2 u, uint features) {
    BsdfSample s = bsdf_null_sample();
    if (!(wo.z > COS_MIN) || p_specular < 0.0f) {
        return s;
    }
    bool specular = bsdf_may_be_specular(features) && u_lobe < p_specular;
    if (specular && bsdf_is_mirror(p, features)) {
        return bsdf_sample_mirror(p, wo, p_specular);
    }
    if (specular) {
        vec3 h = sample_microfacet_normal(p, wo, u, features);
        float o_dot_h = dot(wo, h);
        if (!(o_dot_h > 0.0f)) {
            return s;
        }
        s.direction = normalize(2.0f * o_dot_h * h - wo);
    } else {
        s.direction = sample_cosine_hemisphere(u);
    }
    BsdfValue r = bsdf_eval_pdf_local(p, wo, p_specular, s.direction, features);
    if (r.pdf > 0.0f) {
        s.weight = bsdf_may_be_specular(features) && p_specular > 0.0f ? r.value * (1.0f / r.pdf) : p.diffuse;
        s.pdf = r.pdf;
        s.lobe = specular ? LOBE_SPECULAR : LOBE_DIFFUSE;
    }
    return s;
}

FN BsdfSample bsdf_sample_local(IN(BsdfParameters) p, vec3 wo, float u_lobe, vec2 u, uint features) {
    return bsdf_sample_local(p, wo, bsdf_specular_probability(p, wo, features), u_lobe, u, features);
}

SHARED_END

#endif
