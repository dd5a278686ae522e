// The facets that can stand for a normal map (Schüssler, Heitz, Hanika and Dachsbacher 2017, Microfacet-based normal
// mapping): the mapped facet p, and upright on the surface the tangent facet t, a perfect mirror, which closes the gap so that no light is
// lost to black. Their model follows light over a few facets and drops the rest. Here light that p reflects leaves after at most one more
// mirror reflection, so that a map takes no energy at any tilt (docs/decisions/0008). World space, unit vectors.
#ifndef MICROFACET_NORMAL_MAP_H
#define MICROFACET_NORMAL_MAP_H

#include "bsdf/shading_normal.h"

SHARED_BEGIN

struct FacetPair {
    vec3 normal;   // of the surface, g
    vec3 facet;    // p
    vec3 tangent;  // t, across g, leaning against p
    float cosine;  // p·g
    float sine;
    uint tilted;  // 0: p is g, and the rest is void
};

/// `normal` is the shading normal as bent; the mapped one is turned along with it.
FN FacetPair make_facet_pair(vec3 shading_normal, vec3 normal, vec3 mapped_normal) {
    FacetPair m;
    m.normal = normal;
    // The rotation of shading_normal onto normal.
    vec3 both = shading_normal + normal;
    float turn = dot(both, mapped_normal) / (1.0f + dot(shading_normal, normal));
    vec3 p = mapped_normal + 2.0f * dot(shading_normal, mapped_normal) * normal - turn * both;
    m.facet = bend_toward(normalize(p), normal, MAPPED_COS);
    m.cosine = dot(m.facet, normal);
    vec3 across = m.facet - m.cosine * normal;
    float across2 = dot(across, across);
    m.tilted = across2 > 1.0e-10f ? 1u : 0u;
    m.sine = sqrt(across2);
    m.tangent = normalize(-across / max(m.sine, 1.0e-5f));
    return m;
}

/// Probability that what arrives along w meets the mapped facet, not the tangent one.
FN float mapped_facet_probability(IN(FacetPair) m, vec3 w) {
    float p = max(dot(w, m.facet), 0.0f);
    float t = max(dot(w, m.tangent), 0.0f) * m.sine;
    return p > 0.0f ? p / (p + t) : 0.0f;
}

/// Masking of w by the other facet.
FN float facet_masking(IN(FacetPair) m, vec3 w) {
    float p = max(dot(w, m.facet), 0.0f);
    float t = max(dot(w, m.tangent), 0.0f) * m.sine;
    float g = max(dot(w, m.normal), 0.0f) * m.cosine;
    return g < p + t ? g / (p + t) : 1.0f;
}

/// Off the mirror of the tangent facet; its own inverse.
FN vec3 tangent_reflect(IN(FacetPair) m, vec3 w) {
    return normalize(w - 2.0f * dot(w, m.tangent) * m.tangent);
}

/// Off the mirror of the surface itself: how light leaves that the facet sent below; its own inverse.
FN vec3 surface_reflect(IN(FacetPair) m, vec3 w) {
    return normalize(w - 2.0f * dot(w, m.normal) * m.normal);
}

/// Ways to leave: straight off the mapped facet, by the tangent one, by the surface.
CONST uint FACET_EXITS = 3u;

/// For what leaves along `wi`, above the surface: how the mapped facet sent it, and the share of that direction that goes this way.
FN float facet_exit(IN(FacetPair) m, vec3 wi, uint exit, OUT(vec3) sent) {
    if (exit == 0u) {
        sent = wi;
        return facet_masking(m, wi);
    }
    if (exit == 1u) {
        sent = tangent_reflect(m, wi);
        return dot(wi, m.tangent) > 0.0f ? 1.0f - facet_masking(m, sent) : 0.0f;
    }
    sent = surface_reflect(m, wi);
    return dot(sent, m.facet) > 0.0f ? 1.0f : 0.0f;
}

SHARED_END

#endif
