// The BSDF at a hit, in world space: the functions that kernels call.
#ifndef SURFACE_BSDF_H
#define SURFACE_BSDF_H

#include "bsdf/facet_pair_bsdf.h"
#include "bsdf/mapped_bsdf.h"

SHARED_BEGIN

FN SeenBsdf see_bsdf(IN(SurfaceBsdf) s, vec3 wo, uint features) {
    SeenBsdf seen;
    seen.wo = wo;
    seen.reflects = dot(wo, s.geometric_normal) > 0.0f;
    seen.mapped = NORMAL_MAP_NONE;
    seen.normal = bent_normal(s.shading_normal, s.geometric_normal, wo);
    seen.diffuse_normal = seen.normal;
    if ((features & FEATURE_NORMAL_MAPS) != 0u && s.mapped != NORMAL_MAP_NONE) {
        if ((features & FEATURE_MICROFACET_NORMAL_MAPS) != 0u && s.mapped == NORMAL_MAP_MICROFACET) {
            FacetPair pair = make_facet_pair(s.shading_normal, seen.normal, s.mapped_normal);
            seen.mapped = pair.tilted != 0u ? NORMAL_MAP_MICROFACET : NORMAL_MAP_NONE;
        } else {
            seen.mapped = NORMAL_MAP_SHADING;
            seen.diffuse_normal = bend_toward(s.mapped_normal, s.geometric_normal, MAPPED_COS);
            seen.normal = specular_normal(seen.diffuse_normal, s.geometric_normal, wo);
        }
    }
    seen.frame = frame_from_normal(seen.normal);
    seen.wo_local = to_local(seen.frame, wo);
    seen.p_specular = bsdf_specular_probability(s.parameters, seen.wo_local, features);
    return seen;
}

/// f |cos_i| and its pdf, without delta lobes. Both are 0 unless both directions are on the triangle's outer side, so
/// no light leaks through it.
FN BsdfValue surface_bsdf_eval_pdf(IN(SurfaceBsdf) s, IN(SeenBsdf) seen, vec3 wi, uint features) {
    BsdfValue r;
    r.value = vec3(0.0f, 0.0f, 0.0f);
    r.pdf = 0.0f;
    if (!seen.reflects || !(dot(wi, s.geometric_normal) > 0.0f)) {
        return r;
    }
    if ((features & FEATURE_NORMAL_MAPS) != 0u && seen.mapped != NORMAL_MAP_NONE) {
        if ((features & FEATURE_MICROFACET_NORMAL_MAPS) != 0u && seen.mapped == NORMAL_MAP_MICROFACET) {
            FacetPair pair = make_facet_pair(s.shading_normal, seen.normal, s.mapped_normal);
            return facet_pair_eval_pdf(s.parameters, pair, seen.wo, wi, features);
        }
        return mapped_eval_pdf(s.parameters, seen, s.geometric_normal, wi, features);
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

/// Samples a unit direction in world space on the triangle's outer side. u_lobe.x picks the lobe, u_lobe.y the facet
/// of a microfacet normal map.
FN BsdfSample surface_bsdf_sample(IN(SurfaceBsdf) s, IN(SeenBsdf) seen, vec2 u_lobe, vec2 u, uint features) {
    BsdfSample r = bsdf_null_sample();
    if (!seen.reflects) {
        return r;
    }
    if ((features & FEATURE_NORMAL_MAPS) != 0u && seen.mapped != NORMAL_MAP_NONE) {
        if ((features & FEATURE_MICROFACET_NORMAL_MAPS) != 0u && seen.mapped == NORMAL_MAP_MICROFACET) {
            FacetPair pair = make_facet_pair(s.shading_normal, seen.normal, s.mapped_normal);
            r = facet_pair_sample(s.parameters, pair, seen.wo, u_lobe, u, features);
        } else {
            r = mapped_sample(s.parameters, seen, s.geometric_normal, u_lobe.x, u, features);
        }
    } else {
        r = bsdf_sample_local(s.parameters, seen.wo_local, seen.p_specular, u_lobe.x, u, features);
        r.direction = to_world(seen.frame, r.direction);
        if (r.delta != 0u) {
            r.direction = normalize(r.direction);  // else rounding accumulates over a chain of mirrors
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
