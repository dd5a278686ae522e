// The radiance that surfaces emit: as a ray finds it (material_emission), and as light sampling does (emitter_radiance).
#ifndef EMISSION_KERNEL_H
#define EMISSION_KERNEL_H

#include "geometry/texture.kernel.h"

/// Emitted radiance at a point of a mesh, from a side that emits. An unlit material emits its base colour. `factor` is the material's emission
/// factor at the moment asked for.
FN vec3 emission_at(IN(Material) material, vec3 factor, IN(MeshPoint) p) {
    if ((material.flags & MATERIAL_UNLIT) != 0u) {
        return xyz(base_color(material, p));
    }
    vec3 texel = xyz(slot_value(material.emission_slot, p));
    return factor * MUTANT(EMISSION_OF_RED, texel, vec3(texel.x, texel.x, texel.x));
}

FN vec3 material_emission(IN(Material) material, IN(MeshPoint) p) { return emission_at(material, material.emission, p); }

/// Emitted radiance at barycentrics of a light, times its coverage where it is not opaque: a ray that finds the light there would
/// have passed through it with the complement.
FN vec3 emitter_radiance(IN(EmissiveTriangle) light, vec2 barycentrics) {
    if (!feature(FEATURE_EMISSIVE_TEXTURES) || (light.flags & EMITTER_VARIES) == 0u) {
        return light.radiance;
    }
    LOCAL(Geometry) geometry = load_geometries(light.geometry);
    LOCAL(Material) material = load_materials(geometry.material);
    MeshPoint p = mesh_point(geometry, light.primitive, barycentrics);
    // The light's own factor, not the material's: the light may be of the moment before.
    vec3 radiance = emission_at(material, light.radiance, p);
    if (feature(FEATURE_ALPHA) && (material.flags & (MATERIAL_ALPHA_MASK | MATERIAL_ALPHA_BLEND)) != 0u) {
        radiance = radiance * MUTANT(EMITTER_UNCOVERED, opacity(material, base_color(material, p).w), 1.0f);
    }
    return radiance;
}

#endif
