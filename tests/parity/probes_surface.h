// Probes of bent and mapped normals and of the surface in world space.
#ifndef PROBES_SURFACE_H
#define PROBES_SURFACE_H

#include "probes_bsdf.h"

SHARED_BEGIN

/// How far bend_toward's result moves where v does by 1.
FN float probe_bend_scale(vec3 v, vec3 axis) {
    return 1.0f / max(length(v - dot(v, axis) * axis), 1.0e-6f);
}

FN void probe_bent_normal(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    vec3 bent = bend_toward(p.shading, p.view, BENT_COS);
    put_path(o, dot(p.shading, p.view) >= BENT_COS);
    put_path(o, dot(bent, p.axis) > 0.0f);
    put3(o, bent, probe_bend_scale(p.shading, p.view));
    put3(o, bent_normal(p.shading, p.axis, p.view), probe_bend_scale(p.shading, p.view));
    put3(o, bend_toward(p.axis_2, p.axis, MAPPED_COS), probe_bend_scale(p.axis_2, p.axis));
}

/// How far the mapped facet, and then its tangent, move where the normals do by 1.
FN float probe_facet_turn_scale(IN(ProbeInput) p, IN(FacetPair) m) {
    return 1.0f + 2.0f / max(1.0f + dot(p.shading, m.normal), 1.0e-6f) + 1.0f / max(m.sine, 1.0e-6f);
}

FN float probe_tangent_scale(IN(ProbeInput) p, IN(FacetPair) m) {
    return probe_facet_turn_scale(p, m) / max(m.sine, 1.0e-5f);
}

/// Of the two probabilities, which divide by what w projects onto both facets.
FN float probe_mask_scale(IN(FacetPair) m, vec3 w) {
    float projected = max(dot(w, m.facet), 0.0f) + max(dot(w, m.tangent), 0.0f) * m.sine;
    return projected > 0.0f ? 1.0f / projected : 1.0f;
}

FN void probe_facet_pair(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    FacetPair m = make_facet_pair(p.shading, p.shading, p.mapped);
    put_path(o, m.tilted != 0u);
    put_path(o, m.cosine > 1.01f * MAPPED_COS);
    put3(o, m.facet, probe_facet_turn_scale(p, m));
    put(o, m.cosine, probe_facet_turn_scale(p, m));
    if (m.tilted == 0u) {
        return;
    }
    put(o, m.sine, probe_facet_turn_scale(p, m));
    put3(o, m.tangent, probe_tangent_scale(p, m));
    put(o, tangent_reflect(m, p.view).y, 2.0f * probe_tangent_scale(p, m));
    put(o, surface_reflect(m, p.view).x, 2.0f);
    put_path(o, dot(surface_reflect(m, p.view), m.facet) > 0.0f);
    put_path(o, dot(p.view, m.tangent) > 0.0f);
    vec3 sent;
    float exits = 0.0f;
    for (uint exit = 0u; exit < FACET_EXITS; ++exit) {
        exits += facet_exit(m, p.view, exit, sent);
    }
    float scale = probe_facet_turn_scale(p, m) * probe_mask_scale(m, p.view);
    put_path(o, dot(p.view, m.facet) > 0.0f);
    put(o, mapped_facet_probability(m, p.view), scale);
    put(o, facet_masking(m, p.view), scale);
    put(o, exits, 3.0f * (scale + probe_facet_turn_scale(p, m) * probe_mask_scale(m, tangent_reflect(m, p.view))));
}

/// How far the specular normal moves where the directions do by 1.
FN float probe_specular_normal_scale(vec3 n, vec3 ng, vec3 wo) {
    vec3 across = n - dot(n, ng) * ng;
    vec3 q = specular_normal(n, ng, wo);
    float size = length(across);
    float cos_o = dot(wo, ng);
    float along = dot(wo, across) / max(size, 1.0e-6f);
    return (1.0f + 1.0f / max(size, 1.0e-6f) + 1.0f / max(length(vec2(cos_o, along)), 1.0e-6f)) / max(dot(q, ng), 1.0e-2f);
}

FN float probe_terminator_scale(vec3 n, vec3 ng, vec3 wi, float width) {
    float sine = length(cross(n, ng));
    float cos_i = max(dot(wi, n), 1.0e-6f);
    float range = width * min(TERMINATOR_RANGE, sine) * cos_i;
    return dot(wi, ng) < 1.01f * range ? 2.0f * (1.0f / range + 1.0f / max(sine, 1.0e-6f) + 1.0f / cos_i) : 1.0f;
}

FN void probe_normal_map(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    vec3 n = bend_toward(p.mapped, p.axis, MAPPED_COS);
    put_bits(o, normal_map_model(NORMAL_MAP_SHADING, p.shading, p.mapped));
    put_path(o, dot(p.mapped, p.axis) >= MAPPED_COS);
    put_path(o, dot(p.mapped - dot(p.mapped, p.axis) * p.axis, p.mapped) > 1.0e-12f);
    put3(o, reflect_off(p.axis, p.light), 4.0f);
    float cos_o = dot(p.view, p.axis);
    put_path(o, cos_o > 0.0f);
    float least = min(REFLECTION_COS_SHARE * cos_o, REFLECTION_COS);
    put_path(o, 2.0f * dot(p.view, n) * dot(n, p.axis) - cos_o >= least);
    float bent = probe_bend_scale(p.mapped, p.axis);
    float scale = bent * probe_specular_normal_scale(n, p.axis, p.view);
    float fade = bent * probe_terminator_scale(n, p.axis, p.light, p.alpha);
    if (put_comparable(o, scale + fade)) {
        put3(o, specular_normal(n, p.axis, p.view), scale);
        put(o, terminator_factor(n, p.axis, p.light, p.alpha), fade);
    }
}

FN SurfaceBsdf probe_surface(IN(ProbeInput) p) {
    SurfaceBsdf s;
    s.parameters = probe_parameters(p);
    s.geometric_normal = p.axis;
    s.shading_normal = p.shading;
    s.mapped_normal = p.mapped;
    s.mapped = (p.words.x >> 2) % 3u;
    return s;
}

/// Which branches of the surface's set-up were taken.
FN void put_seen_path(INOUT(ProbeOutput) o, IN(SeenBsdf) seen) {
    put_path(o, seen.reflects);
    put_bits(o, seen.mapped);
    put_path(o, seen.normal.z >= -0.0625f);
    put_path(o, seen.wo_local.z > COS_MIN);
}

FN void probe_see(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    SurfaceBsdf s = probe_surface(p);
    SeenBsdf seen = see_bsdf(s, p.view, probe_features(p));
    put_seen_path(o, seen);
    put_path(o, dot(p.shading, p.view) >= BENT_COS);
    float scale = probe_bend_scale(p.shading, p.view);
    put3(o, seen.normal, scale);
    put3(o, seen.frame.tangent, scale);
    put3(o, seen.wo_local, scale);
    put(o, seen.p_specular, scale);
}

/// Of everything at once: where the frame moved, wi moves in it.
FN float probe_surface_scale(IN(SurfaceBsdf) s, IN(SeenBsdf) seen, vec3 wi, uint features) {
    return probe_bend_scale(s.shading_normal, seen.wo) *
           probe_moved_scale(s.parameters, seen.wo_local, to_local(seen.frame, wi), features);
}

FN void probe_surface_eval(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    SurfaceBsdf s = probe_surface(p);
    s.mapped = NORMAL_MAP_NONE;
    uint features = probe_features(p);
    SeenBsdf seen = see_bsdf(s, p.view, features);
    put_seen_path(o, seen);
    put_path(o, dot(p.shading, p.view) >= BENT_COS);
    put_path(o, dot(p.light, p.axis) > 0.0f);
    float above = dot(p.light, seen.normal);
    put_path(o, above > COS_MIN);
    BsdfValue v = surface_bsdf_eval_pdf(s, seen, p.light, features);
    float scale = probe_surface_scale(s, seen, p.light, features);
    if (!put_comparable(o, scale)) {
        return;
    }
    float size = max_component(v.value) + max_component(s.parameters.diffuse) * max(above, 0.0f);
    put3(o, v.value, size * scale);
    put(o, v.pdf, v.pdf * scale);
    BsdfValue again = surface_bsdf_eval_pdf(s, p.view, p.light, features);
    put(o, again.pdf, v.pdf * scale);
    put3(o, surface_bsdf_eval(s, p.view, p.light, features), size * scale);
    put(o, surface_bsdf_pdf(s, p.view, p.light, features), v.pdf * scale);
}

FN void probe_surface_sample(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    SurfaceBsdf s = probe_surface(p);
    s.mapped = NORMAL_MAP_NONE;
    uint features = probe_features(p);
    vec2 u = vec2(p.u.x, p.u.y);
    SeenBsdf seen = see_bsdf(s, p.view, features);
    put_seen_path(o, seen);
    put_path(o, dot(p.shading, p.view) >= BENT_COS);
    BsdfSample r = surface_bsdf_sample(s, p.view, vec2(p.u.z, p.u.w), u, features);
    bool specular = p.u.z < seen.p_specular;
    put_path(o, specular);
    put_path(o, r.pdf > 0.0f);
    if (!(r.pdf > 0.0f)) {
        return;
    }
    put_bits(o, r.delta);
    float alpha = clamp(s.parameters.alpha, ALPHA_MIRROR, 1.0f);
    float moved = probe_bend_scale(p.shading, p.view);
    if (specular && r.delta == 0u && !bsdf_is_blinn_phong(s.parameters, features)) {
        vec3 h = sample_ggx_visible_normal(seen.wo_local, alpha, u);
        moved *= probe_facet_scale(seen.wo_local, h, alpha, u);
    }
    put3(o, r.direction, 2.0f * moved);
    float scale = r.delta != 0u ? moved : moved * probe_surface_scale(s, seen, r.direction, features);
    if (!put_comparable(o, scale)) {
        return;
    }
    put3(o, r.weight, (1.0f + max_component(r.weight)) * scale);
    put(o, r.pdf, r.pdf * scale);
}

/// Which lobes of a mapped surface see a direction; where one does not, to within rounding, its part is on or off.
FN void put_lobes_path(INOUT(ProbeOutput) o, IN(SeenBsdf) seen, vec3 ng, vec3 w) {
    put_path(o, dot(w, ng) > COS_MIN);
    put_path(o, dot(w, seen.diffuse_normal) > 0.0f);
    put_path(o, dot(w, seen.normal) > COS_MIN);
    put_path(o, dot(reflect_off(ng, w), seen.normal) > COS_MIN);
}

/// Of a mapped surface's eval and pdf, relative to `size`, which gets what its lobes carry without their fading.
FN float probe_mapped_scale(IN(SurfaceBsdf) s, IN(SeenBsdf) seen, vec3 wi, uint features, OUT(float) size) {
    vec3 ng = s.geometric_normal;
    vec3 wi_local = to_local(seen.frame, wi);
    vec3 below = to_local(seen.frame, reflect_off(ng, wi));
    BsdfValue straight = bsdf_eval_pdf_local(s.parameters, seen.wo_local, seen.p_specular, wi_local, features);
    BsdfValue lifted = bsdf_eval_pdf_local(s.parameters, seen.wo_local, seen.p_specular, below, features);
    size = 1.0f + max_component(straight.value) + max_component(lifted.value) + straight.pdf + lifted.pdf;
    float turned = probe_bend_scale(s.mapped_normal, ng) * probe_specular_normal_scale(seen.diffuse_normal, ng, seen.wo);
    float lobes = probe_moved_scale(s.parameters, seen.wo_local, wi_local, features) +
                  probe_moved_scale(s.parameters, seen.wo_local, below, features);
    float alpha = clamp(s.parameters.alpha, ALPHA_MIRROR, 1.0f);
    return turned * (lobes + 1.0f / max(length(seen.wo + wi), 1.0e-6f)) +
           turned * (probe_terminator_scale(seen.diffuse_normal, ng, wi, 1.0f) + probe_terminator_scale(seen.normal, ng, wi, alpha));
}

FN void put_mapped_seen(INOUT(ProbeOutput) o, IN(ProbeInput) p, IN(SeenBsdf) seen) {
    put_seen_path(o, seen);
    put_path(o, dot(p.mapped, p.axis) >= MAPPED_COS);
    float cos_o = dot(p.view, p.axis);
    float least = min(REFLECTION_COS_SHARE * cos_o, REFLECTION_COS);
    put_path(o, 2.0f * dot(p.view, seen.diffuse_normal) * dot(seen.diffuse_normal, p.axis) - cos_o >= least);
    put_path(o, seen.diffuse_normal.z >= -0.0625f);
}

FN void probe_mapped_eval(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    SurfaceBsdf s = probe_surface(p);
    s.mapped = NORMAL_MAP_SHADING;
    uint features = probe_features(p) | FEATURE_NORMAL_MAPS;
    SeenBsdf seen = see_bsdf(s, p.view, features);
    put_mapped_seen(o, p, seen);
    put_lobes_path(o, seen, p.axis, p.light);
    float size;
    float scale = probe_mapped_scale(s, seen, p.light, features, size);
    if (put_comparable(o, scale)) {
        BsdfValue v = mapped_eval_pdf(s.parameters, seen, p.axis, p.light, features);
        put3(o, v.value, size * scale);
        put(o, v.pdf, size * scale);
    }
}

FN void probe_mapped_sample(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    SurfaceBsdf s = probe_surface(p);
    s.mapped = NORMAL_MAP_SHADING;
    uint features = probe_features(p) | FEATURE_NORMAL_MAPS;
    vec2 u = vec2(p.u.x, p.u.y);
    SeenBsdf seen = see_bsdf(s, p.view, features);
    put_mapped_seen(o, p, seen);
    bool specular = bsdf_may_be_specular(features) && p.u.z < seen.p_specular;
    put_path(o, specular);
    BsdfSample r = mapped_sample(s.parameters, seen, p.axis, p.u.z, u, features);
    put_path(o, r.pdf > 0.0f);
    if (!(r.pdf > 0.0f)) {
        return;
    }
    put_bits(o, r.delta);
    put_lobes_path(o, seen, p.axis, r.direction);
    float alpha = clamp(s.parameters.alpha, ALPHA_MIRROR, 1.0f);
    float turned = probe_bend_scale(p.mapped, p.axis) * probe_specular_normal_scale(seen.diffuse_normal, p.axis, p.view);
    float moved = 1.0f;
    if (specular && r.delta == 0u && !bsdf_is_blinn_phong(s.parameters, features)) {
        vec3 h = sample_ggx_visible_normal(seen.wo_local, alpha, u);
        moved *= probe_facet_scale(seen.wo_local, h, alpha, u) + 1.0f / max(seen.wo_local.z, 1.0e-7f);
        vec3 reflected = 2.0f * dot(seen.wo_local, h) * h - seen.wo_local;
        put_path(o, dot(to_world(seen.frame, reflected), p.axis) < 0.0f);
    }
    put3(o, r.direction, 2.0f * turned * moved);
    float size;
    float scale = moved * probe_mapped_scale(s, seen, r.direction, features, size);
    if (!put_comparable(o, scale)) {
        return;
    }
    put(o, r.pdf, (r.delta != 0u ? 1.0f : size) * scale);
    put3(o, r.weight, (1.0f + max_component(r.weight)) * scale * (r.delta != 0u ? 1.0f : size / r.pdf));
}

/// What the paths over both facets carry at most, and how sharply.
FN BsdfValue probe_mapped_size(IN(BsdfParameters) b, IN(FacetPair) m, vec3 wo, vec3 wi, uint features,
                               OUT(float) sharpness) {
    Frame frame = frame_from_normal(m.facet);
    BsdfValue sum;
    sum.value = b.diffuse;
    sum.pdf = 1.0f;
    sharpness = 0.0f;
    for (uint path = 0u; path < 6u; ++path) {
        vec3 o = path < 3u ? wo : tangent_reflect(m, wo);
        vec3 i = path % 3u == 0u ? wi : (path % 3u == 1u ? tangent_reflect(m, wi) : surface_reflect(m, wi));
        BsdfValue v = bsdf_eval_pdf_in_frame(b, frame, o, i, features);
        sum.value += v.value;
        sum.pdf += v.pdf;
        sharpness += probe_moved_scale(b, to_local(frame, o), to_local(frame, i), features);
    }
    return sum;
}

/// Which of the facets see both directions; where one does not, to within rounding, a path is on or off.
FN void put_mapped_path(INOUT(ProbeOutput) o, IN(FacetPair) m, vec3 w) {
    put_path(o, dot(w, m.facet) > COS_MIN);
    put_path(o, dot(w, m.tangent) > 0.0f);
    put_path(o, dot(tangent_reflect(m, w), m.facet) > COS_MIN);
    put_path(o, dot(surface_reflect(m, w), m.facet) > COS_MIN);
    put_path(o, dot(w, m.normal) > COS_MIN);
}

FN void probe_facet_pair_eval(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    BsdfParameters b = probe_parameters(p);
    uint features = probe_features(p);
    FacetPair m = make_facet_pair(p.shading, p.shading, p.mapped);
    put_path(o, m.tilted != 0u);
    put_path(o, m.facet.z >= -0.0625f);
    if (m.tilted == 0u) {
        return;
    }
    put_mapped_path(o, m, p.view);
    put_mapped_path(o, m, p.light);
    BsdfValue v = facet_pair_eval_pdf(b, m, p.view, p.light, features);
    float sharpness;
    BsdfValue size = probe_mapped_size(b, m, p.view, p.light, features, sharpness);
    float masks =
        probe_mask_scale(m, p.view) + probe_mask_scale(m, p.light) + probe_mask_scale(m, tangent_reflect(m, p.light));
    float scale = probe_tangent_scale(p, m) * (sharpness + masks);
    if (!put_comparable(o, scale)) {
        return;
    }
    put3(o, v.value, max_component(size.value) * scale);
    put(o, v.pdf, size.pdf * scale);
}

FN void probe_facet_pair_sample(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    BsdfParameters b = probe_parameters(p);
    uint features = probe_features(p);
    vec2 u = vec2(p.u.x, p.u.y);
    FacetPair m = make_facet_pair(p.shading, p.shading, p.mapped);
    put_path(o, m.tilted != 0u);
    put_path(o, m.facet.z >= -0.0625f);
    if (m.tilted == 0u) {
        return;
    }
    put_mapped_path(o, m, p.view);
    float p_facet = mapped_facet_probability(m, p.view);
    bool on_facet = p.u.w < p_facet;
    put_path(o, on_facet);
    vec3 start = p.view;
    if (!on_facet) {
        start = tangent_reflect(m, p.view);
    }
    Frame frame = frame_from_normal(m.facet);
    vec3 start_local = to_local(frame, start);
    bool specular = p.u.z < bsdf_specular_probability(b, start_local, features);
    put_path(o, specular);
    BsdfSample first = bsdf_sample_in_frame(b, frame, start, p.u.z, u, features);
    float path = on_facet ? p_facet : 1.0f - p_facet;
    put_path(o, dot(first.direction, m.normal) > 0.0f);
    put_path(o, (on_facet ? p.u.w : p.u.w - p_facet) < path * facet_masking(m, first.direction));
    BsdfSample r = facet_pair_sample(b, m, p.view, vec2(p.u.z, p.u.w), u, features);
    put_path(o, r.pdf > 0.0f);
    if (!(r.pdf > 0.0f)) {
        return;
    }
    put_mapped_path(o, m, r.direction);
    float alpha = clamp(b.alpha, ALPHA_MIRROR, 1.0f);
    float moved = probe_tangent_scale(p, m);
    if (specular && r.delta == 0u && !bsdf_is_blinn_phong(b, features)) {
        moved *= probe_facet_scale(start_local, sample_ggx_visible_normal(start_local, alpha, u), alpha, u) +
                 1.0f / max(start_local.z, 1.0e-7f);
    }
    put3(o, r.direction, 2.0f * moved);
    float sharpness;
    BsdfValue size = probe_mapped_size(b, m, p.view, r.direction, features, sharpness);
    float masks = probe_mask_scale(m, p.view) + probe_mask_scale(m, r.direction) +
                  probe_mask_scale(m, tangent_reflect(m, r.direction));
    float scale = r.delta != 0u ? moved * (1.0f + masks) : moved * (sharpness + masks);
    if (!put_comparable(o, scale)) {
        return;
    }
    put(o, r.pdf, (r.delta != 0u ? 1.0f : size.pdf) * scale);
    put3(o, r.weight, (1.0f + max_component(r.weight)) * scale * (r.delta != 0u ? 1.0f : size.pdf / r.pdf));
}

SHARED_END

// See probe_list.h.
#define SURFACE_PROBES(X)                                                                                              \
    X(bent_normal, 24, 200, "inversesqrt, normalize")                                                                  \
    X(facet_pair, 48, 200, "a division, two normalizes")                                                            \
    X(see, 48, 200, "the bent normal's, then a frame")                                                                 \
    X(surface_eval, 96, 300, "the frame's, then eval's")                                                               \
    X(surface_sample, 96, 400, "the frame's, then sample's")                                                           \
    X(normal_map, 48, 200, "a bent normal; an inversesqrt, a sqrt, two divisions and a normalize")                     \
    X(mapped_eval, 96, 1000, "the specular normal's, then eval's twice")                                               \
    X(mapped_sample, 96, 1000, "the same, then sample's")                                                              \
    X(facet_pair_eval, 192, 3000, "a map that tilts by 1e-5 knows its tangent to 1 %; both facets', then eval's thrice")   \
    X(facet_pair_sample, 192, 3000, "the same; both facets', then sample's")

#endif
