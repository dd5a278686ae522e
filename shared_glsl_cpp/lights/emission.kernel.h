// The radiance that surfaces emit: for a ray that hits the surface (material_emission) and for light sampling
// (emitter_radiance).
#ifndef EMISSION_KERNEL_H
#define EMISSION_KERNEL_H

#include "geometry/texture.kernel.h"

/// Radiance emitted at a point of a mesh, on a side that emits. An unlit material emits its base colour. `factor` is
/// the material's emission factor, which may differ between moments.
FN vec3 emission_at(IN(Material) material, vec3 factor, IN(MeshPoint) p) {
    if ((material.flags & MATERIAL_UNLIT) != 0u) {
        return xyz(base_color(material, p));
    }
    vec3 texel = xyz(slot_value(material.emission_slot, p));
    return factor * MUTANT(EMISSION_OF_RED, texel, vec3(texel.x, texel.x, texel.x));
}

FN vec3 material_emission(IN(Material) material, IN(MeshPoint) p) { return emission_at(material, material.emission, p); }

/// Radiance emitted at barycentrics of a light, times its opacity. A ray that hits the light there passes through it
/// with probability 1 - opacity.
FN vec3 emitter_radiance(IN(EmissiveTriangle) light, vec2 barycentrics) {
    if (!feature(FEATURE_EMISSIVE_TEXTURES) || (light.flags & EMITTER_VARIES) == 0u) {
        return light.radiance;
    }
    LOCAL(Geometry) geometry = load_geometries(light.geometry);
    LOCAL(Material) material = load_materials(geometry.material);
    MeshPoint p = mesh_point(geometry, light.primitive, barycentrics);
    // The factor is the light's, not the material's, because the light may be that of the previous moment.
    vec3 radiance = emission_at(material, light.radiance, p);
    if (feature(FEATURE_ALPHA) && (material.flags & (MATERIAL_ALPHA_MASK | MATERIAL_ALPHA_BLEND)) != 0u) {
        radiance = radiance * MUTANT(EMITTER_UNCOVERED, opacity(material, base_color(material, p).w), 1.0f);
    }
    return radiance;
}

#endif
