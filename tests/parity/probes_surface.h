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
    put3(o, bend_toward(p.axis_2, p.axis, FACET_COS), probe_bend_scale(p.axis_2, p.axis));
}

/// How far the mapped facet, and then its tangent, move where the normals do by 1.
FN float probe_facet_turn_scale(IN(ProbeInput) p, IN(MappedNormal) m) {
    return 1.0f + 2.0f / max(1.0f + dot(p.shading, m.normal), 1.0e-6f) + 1.0f / max(m.sine, 1.0e-6f);
}

FN float probe_tangent_scale(IN(ProbeInput) p, IN(MappedNormal) m) {
    return probe_facet_turn_scale(p, m) / max(m.sine, 1.0e-5f);
}

/// Of the two probabilities, which divide by what w projects onto both facets.
FN float probe_mask_scale(IN(MappedNormal) m, vec3 w) {
    float projected = max(dot(w, m.facet), 0.0f) + max(dot(w, m.tangent), 0.0f) * m.sine;
    return projected > 0.0f ? 1.0f / projected : 1.0f;
}

FN void probe_mapped_normal(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    MappedNormal m = make_mapped_normal(p.shading, p.shading, p.mapped);
    put_path(o, m.tilted != 0u);
    put_path(o, m.cosine > 1.01f * FACET_COS);
    put3(o, m.facet, probe_facet_turn_scale(p, m));
    put(o, m.cosine, probe_facet_turn_scale(p, m));
    if (m.tilted == 0u) {
        return;
    }
    put(o, m.sine, probe_facet_turn_scale(p, m));
    put3(o, m.tangent, probe_tangent_scale(p, m));
    put(o, mapped_reflect(m, p.view).y, 2.0f * probe_tangent_scale(p, m));
    put(o, mapped_lift(m, p.view).x, 2.0f);
    put_path(o, dot(mapped_lift(m, p.view), m.facet) > 0.0f);
    put_path(o, dot(p.view, m.tangent) > 0.0f);
    vec3 sent;
    float exits = 0.0f;
    for (uint exit = 0u; exit < MAPPED_EXITS; ++exit) {
        exits += mapped_exit(m, p.view, exit, sent);
    }
    float scale = probe_facet_turn_scale(p, m) * probe_mask_scale(m, p.view);
    put_path(o, dot(p.view, m.facet) > 0.0f);
    put(o, mapped_facet_probability(m, p.view), scale);
    put(o, mapped_masking(m, p.view), scale);
    put(o, exits, 3.0f * (scale + probe_facet_turn_scale(p, m) * probe_mask_scale(m, mapped_reflect(m, p.view))));
}

FN SurfaceBsdf probe_surface(IN(ProbeInput) p) {
    SurfaceBsdf s;
    s.parameters = probe_parameters(p);
    s.geometric_normal = p.axis;
    s.shading_normal = p.shading;
    s.mapped_normal = p.mapped;
    s.mapped = (p.words.x >> 2) & 1u;
    return s;
}

/// Which branches of the surface's set-up were taken.
FN void put_seen_path(INOUT(ProbeOutput) o, IN(SeenBsdf) seen) {
    put_path(o, seen.reflects);
    put_path(o, seen.mapped);
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
    s.mapped = 0u;
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
    s.mapped = 0u;
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

/// What the paths over both facets carry at most, and how sharply.
FN BsdfValue probe_mapped_size(IN(BsdfParameters) b, IN(MappedNormal) m, vec3 wo, vec3 wi, uint features,
                               OUT(float) sharpness) {
    Frame frame = frame_from_normal(m.facet);
    BsdfValue sum;
    sum.value = b.diffuse;
    sum.pdf = 1.0f;
    sharpness = 0.0f;
    for (uint path = 0u; path < 6u; ++path) {
        vec3 o = path < 3u ? wo : mapped_reflect(m, wo);
        vec3 i = path % 3u == 0u ? wi : (path % 3u == 1u ? mapped_reflect(m, wi) : mapped_lift(m, wi));
        BsdfValue v = bsdf_eval_pdf_in_frame(b, frame, o, i, features);
        sum.value += v.value;
        sum.pdf += v.pdf;
        sharpness += probe_moved_scale(b, to_local(frame, o), to_local(frame, i), features);
    }
    return sum;
}

/// Which of the facets see both directions; where one does not, to within rounding, a path is on or off.
FN void put_mapped_path(INOUT(ProbeOutput) o, IN(MappedNormal) m, vec3 w) {
    put_path(o, dot(w, m.facet) > COS_MIN);
    put_path(o, dot(w, m.tangent) > 0.0f);
    put_path(o, dot(mapped_reflect(m, w), m.facet) > COS_MIN);
    put_path(o, dot(mapped_lift(m, w), m.facet) > COS_MIN);
    put_path(o, dot(w, m.normal) > COS_MIN);
}

FN void probe_mapped_eval(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    BsdfParameters b = probe_parameters(p);
    uint features = probe_features(p);
    MappedNormal m = make_mapped_normal(p.shading, p.shading, p.mapped);
    put_path(o, m.tilted != 0u);
    put_path(o, m.facet.z >= -0.0625f);
    if (m.tilted == 0u) {
        return;
    }
    put_mapped_path(o, m, p.view);
    put_mapped_path(o, m, p.light);
    BsdfValue v = mapped_eval_pdf(b, m, p.view, p.light, features);
    float sharpness;
    BsdfValue size = probe_mapped_size(b, m, p.view, p.light, features, sharpness);
    float masks =
        probe_mask_scale(m, p.view) + probe_mask_scale(m, p.light) + probe_mask_scale(m, mapped_reflect(m, p.light));
    float scale = probe_tangent_scale(p, m) * (sharpness + masks);
    if (!put_comparable(o, scale)) {
        return;
    }
    put3(o, v.value, max_component(size.value) * scale);
    put(o, v.pdf, size.pdf * scale);
}

FN void probe_mapped_sample(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    BsdfParameters b = probe_parameters(p);
    uint features = probe_features(p);
    vec2 u = vec2(p.u.x, p.u.y);
    MappedNormal m = make_mapped_normal(p.shading, p.shading, p.mapped);
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
        start = mapped_reflect(m, p.view);
    }
    Frame frame = frame_from_normal(m.facet);
    vec3 start_local = to_local(frame, start);
    bool specular = p.u.z < bsdf_specular_probability(b, start_local, features);
    put_path(o, specular);
    BsdfSample first = bsdf_sample_in_frame(b, frame, start, p.u.z, u, features);
    float path = on_facet ? p_facet : 1.0f - p_facet;
    put_path(o, dot(first.direction, m.normal) > 0.0f);
    put_path(o, (on_facet ? p.u.w : p.u.w - p_facet) < path * mapped_masking(m, first.direction));
    BsdfSample r = mapped_sample(b, m, p.view, vec2(p.u.z, p.u.w), u, features);
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
                  probe_mask_scale(m, mapped_reflect(m, r.direction));
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
    X(mapped_normal, 48, 200, "a division, two normalizes")                                                            \
    X(see, 48, 200, "the bent normal's, then a frame")                                                                 \
    X(surface_eval, 96, 300, "the frame's, then eval's")                                                               \
    X(surface_sample, 96, 400, "the frame's, then sample's")                                                           \
    X(mapped_eval, 192, 3000, "a map that tilts by 1e-5 knows its tangent to 1 %; both facets', then eval's thrice")   \
    X(mapped_sample, 192, 3000, "the same; both facets', then sample's")

#endif
