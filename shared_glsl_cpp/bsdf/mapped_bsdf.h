// The BSDF of a surface that is shaded with a normal map's normal. The diffuse lobe is about the mapped normal. The
// specular lobe is about a normal that keeps reflections above the surface (docs/integrand.md, "Normal maps", equation
// 4). World space.
#ifndef MAPPED_BSDF_H
#define MAPPED_BSDF_H

#include "bsdf/normal_map.h"
#include "bsdf/seen_bsdf.h"

SHARED_BEGIN

/// f cos_i and pdf. ng is on wo's side.
FN BsdfValue mapped_eval_pdf(IN(BsdfParameters) b, IN(SeenBsdf) seen, vec3 ng, vec3 wi, uint features) {
    BsdfValue sum;
    sum.value = vec3(0.0f, 0.0f, 0.0f);
    sum.pdf = 0.0f;
    if (!(dot(wi, ng) > COS_MIN) || seen.p_specular < 0.0f) {
        return sum;
    }
    bool specular = bsdf_may_be_specular(features) && seen.p_specular > 0.0f;
    float cos_i = dot(wi, seen.diffuse_normal);
    if (cos_i > 0.0f) {
        vec3 kept = vec3(1.0f, 1.0f, 1.0f);
        if (specular) {
            kept -= fresnel_schlick(b.f0, b.f90, 0.5f * length(seen.wo + wi));
        }
        float factor = terminator_factor(seen.diffuse_normal, ng, wi, 1.0f);
        sum.value = b.diffuse * kept * (INV_PI * cos_i * factor);
        sum.pdf = (1.0f - max(seen.p_specular, 0.0f)) * pdf_cosine_hemisphere_solid_angle(cos_i);
    }
    if (specular && !bsdf_is_mirror(b, features)) {
        float factor = terminator_factor(seen.normal, ng, wi, b.alpha);
        BsdfValue straight = microfacet_eval_pdf(b, seen.wo_local, to_local(seen.frame, wi), features);
        vec3 below = to_local(seen.frame, reflect_off(ng, wi));
        BsdfValue lifted = microfacet_eval_pdf(b, seen.wo_local, below, features);
        sum.value += factor * (straight.value + MUTANT(NORMAL_MAP_LOSES, lifted.value, vec3(0.0f, 0.0f, 0.0f)));
        sum.pdf += seen.p_specular * (straight.pdf + lifted.pdf);
    }
    return sum;
}

/// Samples a direction from one of the lobes, which u_lobe picks.
FN BsdfSample mapped_sample(IN(BsdfParameters) b, IN(SeenBsdf) seen, vec3 ng, float u_lobe, vec2 u, uint features) {
    BsdfSample r = bsdf_null_sample();
    if (seen.p_specular < 0.0f) {
        return r;
    }
    vec3 direction;
    bool specular = bsdf_may_be_specular(features) && u_lobe < seen.p_specular;
    if (specular) {
        if (!(seen.wo_local.z > COS_MIN)) {
            return r;
        }
        if (bsdf_is_mirror(b, features)) {
            r = bsdf_sample_mirror(b, seen.wo_local, seen.p_specular);
            r.direction = normalize(to_world(seen.frame, r.direction));
            return r;
        }
        vec3 h = sample_microfacet_normal(b, seen.wo_local, u, features);
        float o_dot_h = dot(seen.wo_local, h);
        if (!(o_dot_h > 0.0f)) {
            return r;
        }
        vec3 reflected = normalize(2.0f * o_dot_h * h - seen.wo_local);
        if (!(reflected.z > COS_MIN)) {
            return r;  // below the horizon of the specular normal
        }
        direction = normalize(to_world(seen.frame, reflected));
        if (dot(direction, ng) < 0.0f) {
            direction = normalize(reflect_off(ng, direction));
        }
    } else {
        direction = normalize(to_world(frame_from_normal(seen.diffuse_normal), sample_cosine_hemisphere(u)));
    }
    BsdfValue v = mapped_eval_pdf(b, seen, ng, direction, features);
    if (!(v.pdf > 0.0f)) {
        return r;
    }
    r.direction = direction;
    r.weight = v.value / v.pdf;
    r.pdf = v.pdf;
    r.lobe = specular ? LOBE_SPECULAR : LOBE_DIFFUSE;
    return r;
}

SHARED_END

#endif
