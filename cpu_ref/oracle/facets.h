// The bent normal of a surface without a map, and the model `microfacet` of normal maps: microfacet-based normal
// mapping (Schüssler, Heitz, Hanika and Dachsbacher 2017) with a specular tangent facet, as docs/integrand.md words both.
#pragma once

#include "oracle/bsdf.h"

namespace diptych::core::oracle {

/// The microsurface at a point: flat with normal g, or a facet p with a mirror t across g.
struct Facets {
    dvec3 geometric{0};  // of the triangle, on the viewer's side
    dvec3 g{0};          // the bent shading normal
    dvec3 p{0};          // the facet
    dvec3 t{0};          // the tangent facet; 0 where p = g
    double cosine = 1;   // p·g
    double sine = 0;     // of the angle between p and g

    bool is_flat() const { return sine == 0; }
};

/// Least cosine of a light's direction to the surface that a normal map is on, in either model.
inline constexpr double least_light_cosine = 1e-7;

/// The mapped normal p, held to a cosine of 0.01 or more to `axis`: the nearest unit vector that has it.
dvec3 held_above(const dvec3& p, const dvec3& axis);

/// n and mapped: mesh and mapped normal (the same one where there is no map), n on the side of `geometric`.
Facets make_facets(const dvec3& geometric, const dvec3& n, const dvec3& mapped, const dvec3& o);

/// f(o, i) |i·n| in all, without what mirrors of the material make of it.
dvec3 evaluate(const Facets& facets, const Bsdf& bsdf, const dvec3& o, const dvec3& i);

/// Draws a path over the facets; `only_mirror` leaves out what `evaluate` has.
Scattered sample(const Facets& facets, const Bsdf& bsdf, const dvec3& o, bool only_mirror, Random& random);

/// Of the draws of `sample` that leave toward i, a steradian, over all paths of the facets; what mirrors of the
/// material draw left out.
double density(const Facets& facets, const Bsdf& bsdf, const dvec3& o, const dvec3& i);

}  // namespace diptych::core::oracle
