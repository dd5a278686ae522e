// The BSDF over the two facets that represent a normal map (microfacet_normal_map.h), in world space.
#ifndef FACET_PAIR_BSDF_H
#define FACET_PAIR_BSDF_H

#include "bsdf/bsdf.h"
#include "bsdf/frame.h"
#include "bsdf/microfacet_normal_map.h"

SHARED_BEGIN

FN BsdfValue bsdf_eval_pdf_in_frame(IN(BsdfParameters) p, IN(Frame) frame, vec3 wo, vec3 wi, uint features) {
    return bsdf_eval_pdf_local(p, to_local(frame, wo), to_local(frame, wi), features);
}

FN BsdfSample bsdf_sample_in_frame(IN(BsdfParameters) p, IN(Frame) frame, vec3 wo, float u_lobe, vec2 u,
                                   uint features) {
    BsdfSample r = bsdf_sample_local(p, to_local(frame, wo), u_lobe, u, features);
    r.direction = normalize(to_world(frame, r.direction));
    return r;
}

/// f cos_i and pdf, summed over both facets that wo may meet first and over all exits (facet_exit).
FN BsdfValue facet_pair_eval_pdf(IN(BsdfParameters) p, IN(FacetPair) m, vec3 wo, vec3 wi, uint features) {
    BsdfValue sum;
    sum.value = vec3(0.0f, 0.0f, 0.0f);
    sum.pdf = 0.0f;
    if (!(dot(wi, m.normal) > COS_MIN)) {
        return sum;
    }
    Frame frame = frame_from_normal(m.facet);
    float p_facet = mapped_facet_probability(m, wo);
    for (uint exit = 0u; exit < FACET_EXITS; ++exit) {
        vec3 sent;
        float taken = facet_exit(m, wi, exit, sent);
        taken = MUTANT(NORMAL_MAP_LOSES, taken, exit == 2u ? 0.0f : taken);
        for (uint first = 0u; first < 2u && taken > 0.0f; ++first) {
            float share = first == 0u ? p_facet : 1.0f - p_facet;
            if (share > 0.0f) {
                vec3 seen_from = wo;
                if (first == 1u) {
                    seen_from = tangent_reflect(m, wo);
                }
                BsdfValue v = bsdf_eval_pdf_in_frame(p, frame, seen_from, sent, features);
                sum.value += (share * taken) * v.value;
                sum.pdf += share * taken * v.pdf;
            }
        }
    }
    return sum;
}

/// Samples one path over the facets. u.x picks the lobe. u.y picks the facet that wo meets; the rest of u.y, rescaled
/// to [0, 1), decides whether the tangent facet catches a direction that leaves the mapped facet.
FN BsdfSample facet_pair_sample(IN(BsdfParameters) p, IN(FacetPair) m, vec3 wo, vec2 u_lobe, vec2 u, uint features) {
    Frame frame = frame_from_normal(m.facet);
    float p_facet = mapped_facet_probability(m, wo);
    bool on_facet = u_lobe.y < p_facet;
    float path = on_facet ? p_facet : 1.0f - p_facet;
    float rest = (on_facet ? u_lobe.y : u_lobe.y - p_facet) / path;
    vec3 start = wo;
    if (!on_facet) {
        start = tangent_reflect(m, wo);
    }
    BsdfSample r = bsdf_sample_in_frame(p, frame, start, u_lobe.x, u, features);
    r.lobe |= on_facet ? FACET_MAPPED : FACET_TANGENT;
    if (!(dot(r.direction, m.normal) > 0.0f)) {
        r.direction = surface_reflect(m, r.direction);
        r.lobe |= FACET_MAPPED | FACET_TANGENT;
    } else {
        float escape = facet_masking(m, r.direction);
        if (rest < escape) {
            path *= escape;
        } else {
            path *= 1.0f - escape;
            r.lobe |= FACET_MAPPED | FACET_TANGENT;
            r.direction = tangent_reflect(m, r.direction);
        }
    }
    if (!(r.pdf > 0.0f) || !(dot(r.direction, m.normal) > COS_MIN)) {
        return bsdf_null_sample();
    }
    if (r.delta != 0u) {
        r.pdf *= path;
        return r;
    }
    BsdfValue v = facet_pair_eval_pdf(p, m, wo, r.direction, features);
    if (!(v.pdf > 0.0f)) {
        return bsdf_null_sample();
    }
    r.weight = v.value / v.pdf;
    r.pdf = v.pdf;
    return r;
}

SHARED_END

#endif
