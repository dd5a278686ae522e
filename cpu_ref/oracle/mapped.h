// The model `shading` of normal maps: the mapped normal takes the place of the surface's (docs/integrand.md: Normal
// maps).
#pragma once

#include "oracle/bsdf.h"

namespace diptych::core::oracle {

/// A point whose normal a map gives, seen from one direction.
struct Mapped {
    dvec3 geometric{0};  // of the triangle, on the viewer's side
    dvec3 p{0};          // the mapped normal, held above the surface: of the diffuse term
    dvec3 q{0};          // p turned until the viewer's mirror direction leaves the surface: of the specular term
};

/// `mapped` is the map's normal on the side of `geometric`, where o is.
Mapped make_mapped(const dvec3& geometric, const dvec3& mapped, const dvec3& o);

/// f(o, i) cos in all, without what mirrors of the material make of it.
dvec3 evaluate(const Mapped& mapped, const Bsdf& bsdf, const dvec3& o, const dvec3& i);

/// Draws the diffuse term or the specular one; `only_mirror` leaves out what `evaluate` has.
Scattered sample(const Mapped& mapped, const Bsdf& bsdf, const dvec3& o, bool only_mirror, Random& random);

/// Of the draws of `sample` that leave toward i, a steradian, both terms together; what mirrors draw left out.
double density(const Mapped& mapped, const Bsdf& bsdf, const dvec3& o, const dvec3& i);

}  // namespace diptych::core::oracle
