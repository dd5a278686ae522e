// Whether a candidate hit counts on a surface with alpha.
#ifndef ALPHA_KERNEL_H
#define ALPHA_KERNEL_H

#include "geometry/texture.kernel.h"

/// MASK compares with its cutoff. BLEND accepts at random with the opacity as probability, so that transparency costs
/// no extra rays. The random number is a hash of the ray's key and the triangle, so repeated tests of one hit agree,
/// and their order does not matter.
FN bool accepts_hit(uint instance, uint geometry, uint primitive, vec2 barycentrics, uint alpha_key) {
    LOCAL(Geometry) g = load_geometries(load_instances(instance).first_geometry + geometry);
    LOCAL(Material) material = load_materials(g.material);
    MeshPoint p = mesh_point(g, primitive, barycentrics);
    float coverage = opacity(material, base_color(material, p).w);
    uint word = pcg4d(uvec4(alpha_key, instance, geometry, primitive)).x;
    return unit_float(word) < coverage;
}

#endif
