// Normals that fit the direction they are seen from, and the facets that stand for a normal map (Schüssler, Heitz,
// Hanika and Dachsbacher 2017, Microfacet-based normal mapping): the mapped facet p, and upright on the surface the
// tangent facet t, a perfect mirror, which closes the gap so that no light is lost to black. Theirs follows light over a few facets
// and drops the rest; here what p reflects leaves after one more mirror at most, so that a map takes no energy at any tilt
// (docs/decisions/0007). World space, unit vectors.
#ifndef NORMAL_MAP_H
#define NORMAL_MAP_H

#include "elementary.h"

SHARED_BEGIN

CONST float BENT_COS = 1.0e-3f;   // of wo to the normal it is shaded with, at the least
CONST float FACET_COS = 1.0e-2f;  // of the mapped facet to the surface, at the least

/// The unit vector nearest to v whose cosine to the unit `axis` is at least `cos_min`; `axis` itself where v opposes
/// it.
FN vec3 bend_toward(vec3 v, vec3 axis, float cos_min) {
    float c = dot(v, axis);
    if (c >= cos_min) {
        return v;
    }
    vec3 across = v - c * axis;
    float across2 = dot(across, across);
    if (!(across2 > 1.0e-12f)) {
        return axis;
    }
    return normalize(cos_min * axis + (safe_sqrt(1.0f - cos_min * cos_min) * inversesqrt(across2)) * across);
}

/// The normal to shade with: ns, turned just so far that wo is above it. At the silhouette of a coarse smooth mesh wo
/// sees the triangle but is below the interpolated normal's horizon, and the surface would be black. ng: on wo's side.
FN vec3 bent_normal(vec3 ns, vec3 ng, vec3 wo) {
    vec3 n = bend_toward(ns, wo, BENT_COS);
    return dot(n, ng) > 0.0f ? n : ng;
}

struct MappedNormal {
    vec3 normal;   // of the surface, g
    vec3 facet;    // p
    vec3 tangent;  // t, across g, leaning against p
    float cosine;  // p·g
    float sine;
    uint tilted;  // 0: p is g, and the rest is void
};

/// `normal` is the shading normal as bent; the mapped one is turned along with it.
FN MappedNormal make_mapped_normal(vec3 shading_normal, vec3 normal, vec3 mapped_normal) {
    MappedNormal m;
    m.normal = normal;
    // The rotation of shading_normal onto normal.
    vec3 both = shading_normal + normal;
    float turn = dot(both, mapped_normal) / (1.0f + dot(shading_normal, normal));
    vec3 p = mapped_normal + 2.0f * dot(shading_normal, mapped_normal) * normal - turn * both;
    m.facet = bend_toward(normalize(p), normal, FACET_COS);
    m.cosine = dot(m.facet, normal);
    vec3 across = m.facet - m.cosine * normal;
    float across2 = dot(across, across);
    m.tilted = across2 > 1.0e-10f ? 1u : 0u;
    m.sine = sqrt(across2);
    m.tangent = normalize(-across / max(m.sine, 1.0e-5f));
    return m;
}

/// Probability that what arrives along w meets the mapped facet, not the tangent one.
FN float mapped_facet_probability(IN(MappedNormal) m, vec3 w) {
    float p = max(dot(w, m.facet), 0.0f);
    float t = max(dot(w, m.tangent), 0.0f) * m.sine;
    return p > 0.0f ? p / (p + t) : 0.0f;
}

/// Masking of w by the other facet.
FN float mapped_masking(IN(MappedNormal) m, vec3 w) {
    float p = max(dot(w, m.facet), 0.0f);
    float t = max(dot(w, m.tangent), 0.0f) * m.sine;
    float g = max(dot(w, m.normal), 0.0f) * m.cosine;
    return g < p + t ? g / (p + t) : 1.0f;
}

/// Off the mirror of the tangent facet; its own inverse.
FN vec3 mapped_reflect(IN(MappedNormal) m, vec3 w) {
    return normalize(w - 2.0f * dot(w, m.tangent) * m.tangent);
}

/// Off the mirror of the surface itself: how light leaves that the facet sent below; its own inverse.
FN vec3 mapped_lift(IN(MappedNormal) m, vec3 w) {
    return normalize(w - 2.0f * dot(w, m.normal) * m.normal);
}

/// Ways to leave: straight off the mapped facet, by the tangent one, by the surface.
CONST uint MAPPED_EXITS = 3u;

/// For what leaves along `wi`, above the surface: how the mapped facet sent it, and the share of that direction that goes this way.
FN float mapped_exit(IN(MappedNormal) m, vec3 wi, uint exit, OUT(vec3) sent) {
    if (exit == 0u) {
        sent = wi;
        return mapped_masking(m, wi);
    }
    if (exit == 1u) {
        sent = mapped_reflect(m, wi);
        return dot(wi, m.tangent) > 0.0f ? 1.0f - mapped_masking(m, sent) : 0.0f;
    }
    sent = mapped_lift(m, wi);
    return dot(sent, m.facet) > 0.0f ? 1.0f : 0.0f;
}

SHARED_END

#endif
