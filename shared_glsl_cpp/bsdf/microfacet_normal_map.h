// The two facets that represent a normal map (Schüssler, Heitz, Hanika and Dachsbacher 2017, "Microfacet-based normal
// mapping"). p is the mapped facet. t is the tangent facet, perpendicular to the surface: a perfect mirror that closes
// the gap, so that no light is lost. The paper follows light over a few facets and drops the rest. Here light that p
// reflects leaves after at most one more mirror reflection, so a map absorbs no energy at any tilt
// (docs/decisions/0008). World space, unit vectors.
#ifndef MICROFACET_NORMAL_MAP_H
#define MICROFACET_NORMAL_MAP_H

#include "bsdf/shading_normal.h"

SHARED_BEGIN

struct FacetPair {
    vec3 normal;   // g, of the surface
    vec3 facet;    // p
    vec3 tangent;  // t, perpendicular to g, on the side that p leans away from
    float cosine;  // p·g
    float sine;
    uint tilted;  // 0: p equals g, and `tangent` is undefined
};

/// `normal` is the bent shading normal. The mapped normal is rotated along with it.
FN FacetPair make_facet_pair(vec3 shading_normal, vec3 normal, vec3 mapped_normal) {
    FacetPair m;
    m.normal = normal;
    // Rotates by the rotation that takes shading_normal to normal.
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

/// Probability that light arriving from w meets the mapped facet and not the tangent facet.
FN float mapped_facet_probability(IN(FacetPair) m, vec3 w) {
    float p = max(dot(w, m.facet), 0.0f);
    float t = max(dot(w, m.tangent), 0.0f) * m.sine;
    return p > 0.0f ? p / (p + t) : 0.0f;
}

/// Masking of the direction w by the other facet.
FN float facet_masking(IN(FacetPair) m, vec3 w) {
    float p = max(dot(w, m.facet), 0.0f);
    float t = max(dot(w, m.tangent), 0.0f) * m.sine;
    float g = max(dot(w, m.normal), 0.0f) * m.cosine;
    return g < p + t ? g / (p + t) : 1.0f;
}

/// Reflection in the tangent facet. It is its own inverse.
FN vec3 tangent_reflect(IN(FacetPair) m, vec3 w) {
    return normalize(w - 2.0f * dot(w, m.tangent) * m.tangent);
}

/// Reflection in the surface: how light leaves that the mapped facet sent below the surface. It is its own inverse.
FN vec3 surface_reflect(IN(FacetPair) m, vec3 w) {
    return normalize(w - 2.0f * dot(w, m.normal) * m.normal);
}

/// Exits: 0 directly from the mapped facet, 1 by way of the tangent facet, 2 by reflection in the surface.
CONST uint FACET_EXITS = 3u;

/// For light that leaves along `wi`, above the surface, by way of `exit`: the direction `sent` in which the mapped
/// facet reflected it. Returns the share of that direction that takes this exit.
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
