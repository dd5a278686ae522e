// The BSDF at a hit, in world space: what kernels call. Three normals: of the triangle, interpolated, and from a normal
// map.
#ifndef SURFACE_BSDF_H
#define SURFACE_BSDF_H

#include "bsdf.h"
#include "frame.h"
#include "normal_map.h"

SHARED_BEGIN

struct SurfaceBsdf {
    BsdfParameters parameters;
    vec3 geometric_normal;  // unit, on wo's side
    vec3 shading_normal;    // unit, interpolated, on the geometric normal's side
    vec3 mapped_normal;     // unit; equals shading_normal where there is no map
    uint mapped;            // 1: the material has a normal map
};

/// What all directions seen from one wo share.
struct SeenBsdf {
    vec3 wo;
    bool reflects;     // wo is on the triangle's outer side
    vec3 normal;       // the shading normal, bent
    Frame frame;       // of that normal; void where `mapped`
    vec3 wo_local;     // in that frame
    float p_specular;  // bsdf_specular_probability
    bool mapped;       // the normal map tilts: mapped_eval_pdf and mapped_sample
};

FN SeenBsdf see_bsdf(IN(SurfaceBsdf) s, vec3 wo, uint features) {
    SeenBsdf seen;
    seen.wo = wo;
    seen.reflects = dot(wo, s.geometric_normal) > 0.0f;
    seen.normal = bent_normal(s.shading_normal, s.geometric_normal, wo);
    seen.frame = frame_from_normal(seen.normal);
    seen.wo_local = to_local(seen.frame, wo);
    seen.p_specular = bsdf_specular_probability(s.parameters, seen.wo_local, features);
    seen.mapped = false;
    if ((features & FEATURE_NORMAL_MAPS) != 0u && s.mapped != 0u) {
        MappedNormal m = make_mapped_normal(s.shading_normal, seen.normal, s.mapped_normal);
        seen.mapped = m.tilted != 0u;
    }
    return seen;
}

FN BsdfValue bsdf_eval_pdf_in_frame(IN(BsdfParameters) p, IN(Frame) frame, vec3 wo, vec3 wi, uint features) {
    return bsdf_eval_pdf_local(p, to_local(frame, wo), to_local(frame, wi), features);
}

FN BsdfSample bsdf_sample_in_frame(IN(BsdfParameters) p, IN(Frame) frame, vec3 wo, float u_lobe, vec2 u,
                                   uint features) {
    BsdfSample r = bsdf_sample_local(p, to_local(frame, wo), u_lobe, u, features);
    r.direction = normalize(to_world(frame, r.direction));
    return r;
}

/// The mapped surface's f cos and pdf: over both facets that wo may meet first, and all ways to leave.
FN BsdfValue mapped_eval_pdf(IN(BsdfParameters) p, IN(MappedNormal) m, vec3 wo, vec3 wi, uint features) {
    BsdfValue sum;
    sum.value = vec3(0.0f, 0.0f, 0.0f);
    sum.pdf = 0.0f;
    if (!(dot(wi, m.normal) > COS_MIN)) {
        return sum;
    }
    Frame frame = frame_from_normal(m.facet);
    float p_facet = mapped_facet_probability(m, wo);
    for (uint exit = 0u; exit < MAPPED_EXITS; ++exit) {
        vec3 sent;
        float taken = mapped_exit(m, wi, exit, sent);
        taken = MUTANT(NORMAL_MAP_LOSES, taken, exit == 2u ? 0.0f : taken);
        for (uint first = 0u; first < 2u && taken > 0.0f; ++first) {
            float share = first == 0u ? p_facet : 1.0f - p_facet;
            if (share > 0.0f) {
                vec3 seen_from = wo;
                if (first == 1u) {
                    seen_from = mapped_reflect(m, wo);
                }
                BsdfValue v = bsdf_eval_pdf_in_frame(p, frame, seen_from, sent, features);
                sum.value += (share * taken) * v.value;
                sum.pdf += share * taken * v.pdf;
            }
        }
    }
    return sum;
}

/// f |cos_i| and its pdf, without delta lobes. No light leaks through the triangle: both directions must be on its outer side.
FN BsdfValue surface_bsdf_eval_pdf(IN(SurfaceBsdf) s, IN(SeenBsdf) seen, vec3 wi, uint features) {
    BsdfValue r;
    r.value = vec3(0.0f, 0.0f, 0.0f);
    r.pdf = 0.0f;
    if (!seen.reflects || !(dot(wi, s.geometric_normal) > 0.0f)) {
        return r;
    }
    if ((features & FEATURE_NORMAL_MAPS) != 0u && seen.mapped) {
        MappedNormal m = make_mapped_normal(s.shading_normal, seen.normal, s.mapped_normal);
        return mapped_eval_pdf(s.parameters, m, seen.wo, wi, features);
    }
    return bsdf_eval_pdf_local(s.parameters, seen.wo_local, seen.p_specular, to_local(seen.frame, wi), features);
}

FN BsdfValue surface_bsdf_eval_pdf(IN(SurfaceBsdf) s, vec3 wo, vec3 wi, uint features) {
    SeenBsdf seen = see_bsdf(s, wo, features);
    return surface_bsdf_eval_pdf(s, seen, wi, features);
}

FN vec3 surface_bsdf_eval(IN(SurfaceBsdf) s, vec3 wo, vec3 wi, uint features) {
    BsdfValue r = surface_bsdf_eval_pdf(s, wo, wi, features);
    return r.value;
}

FN float surface_bsdf_pdf(IN(SurfaceBsdf) s, vec3 wo, vec3 wi, uint features) {
    BsdfValue r = surface_bsdf_eval_pdf(s, wo, wi, features);
    return r.pdf;
}

/// Follows one path: u.x picks the lobe; u.y the facet that wo meets and, stretched over what is left of it, whether a direction off
/// the mapped facet is caught by the tangent one.
FN BsdfSample mapped_sample(IN(BsdfParameters) p, IN(MappedNormal) m, vec3 wo, vec2 u_lobe, vec2 u, uint features) {
    Frame frame = frame_from_normal(m.facet);
    float p_facet = mapped_facet_probability(m, wo);
    bool on_facet = u_lobe.y < p_facet;
    float path = on_facet ? p_facet : 1.0f - p_facet;
    float rest = (on_facet ? u_lobe.y : u_lobe.y - p_facet) / path;
    vec3 start = wo;
    if (!on_facet) {
        start = mapped_reflect(m, wo);
    }
    BsdfSample r = bsdf_sample_in_frame(p, frame, start, u_lobe.x, u, features);
    r.lobe |= on_facet ? FACET_MAPPED : FACET_TANGENT;
    if (!(dot(r.direction, m.normal) > 0.0f)) {
        r.direction = mapped_lift(m, r.direction);
        r.lobe |= FACET_MAPPED | FACET_TANGENT;
    } else {
        float escape = mapped_masking(m, r.direction);
        if (rest < escape) {
            path *= escape;
        } else {
            path *= 1.0f - escape;
            r.lobe |= FACET_MAPPED | FACET_TANGENT;
            r.direction = mapped_reflect(m, r.direction);
        }
    }
    if (!(r.pdf > 0.0f) || !(dot(r.direction, m.normal) > COS_MIN)) {
        return bsdf_null_sample();
    }
    if (r.delta != 0u) {
        r.pdf *= path;
        return r;
    }
    BsdfValue v = mapped_eval_pdf(p, m, wo, r.direction, features);
    if (!(v.pdf > 0.0f)) {
        return bsdf_null_sample();
    }
    r.weight = v.value / v.pdf;
    r.pdf = v.pdf;
    return r;
}

/// A direction in world space, unit, on the triangle's outer side. `u_lobe`: x picks the lobe, y the facet of a normal map.
FN BsdfSample surface_bsdf_sample(IN(SurfaceBsdf) s, IN(SeenBsdf) seen, vec2 u_lobe, vec2 u, uint features) {
    BsdfSample r = bsdf_null_sample();
    if (!seen.reflects) {
        return r;
    }
    if ((features & FEATURE_NORMAL_MAPS) != 0u && seen.mapped) {
        MappedNormal m = make_mapped_normal(s.shading_normal, seen.normal, s.mapped_normal);
        r = mapped_sample(s.parameters, m, seen.wo, u_lobe, u, features);
    } else {
        r = bsdf_sample_local(s.parameters, seen.wo_local, seen.p_specular, u_lobe.x, u, features);
        r.direction = to_world(seen.frame, r.direction);
        if (r.delta != 0u) {
            r.direction = normalize(r.direction);  // a chain of mirrors would add up its roundings
        }
    }
    if (!(dot(r.direction, s.geometric_normal) > 0.0f)) {
        return bsdf_null_sample();
    }
    return r;
}

FN BsdfSample surface_bsdf_sample(IN(SurfaceBsdf) s, vec3 wo, vec2 u_lobe, vec2 u, uint features) {
    SeenBsdf seen = see_bsdf(s, wo, features);
    return surface_bsdf_sample(s, seen, u_lobe, u, features);
}

SHARED_END

#endif
