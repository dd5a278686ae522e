// A point on a triangle as light meets it: material, emission, normals (docs/integrand.md: Surfaces, Material,
// Emission).
#pragma once

#include "oracle/bsdf.h"
#include "oracle/normals.h"
#include "oracle/traversal.h"
#include "oracle/world.h"

namespace diptych::core::oracle {

/// A hit seen from `o`.
struct Surface {
    dvec3 position;
    dvec3 o;       // to the viewer
    dvec3 normal;  // geometric, on o's side
    dvec3 base_color;
    dvec3 emission;  // radiance toward o
    bool scatters;
    Bsdf bsdf;
    Normals normals;  // for shading
};

/// `o` is a unit vector; the surface's `scatters` is false where it is unlit.
Surface make_surface(const World& world, Distribution model, NormalMaps maps, const Hit& hit, const dvec3& o);

/// Radiance that leaves the point toward `o`.
dvec3 emitted(const World& world, const Triangle& triangle, dvec2 barycentrics, const dvec3& o);

/// The probability that the surface is there: 1, 0 or a BLEND's alpha.
double coverage(const World& world, const Triangle& triangle, dvec2 barycentrics);

/// Whether any point of the material could emit.
bool emits(const Material& material);

}  // namespace diptych::core::oracle
