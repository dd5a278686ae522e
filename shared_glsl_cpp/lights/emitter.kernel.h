// Emissive triangles as lights: sampled points, their densities, and light points.
#ifndef EMITTER_KERNEL_H
#define EMITTER_KERNEL_H

#include "geometry/surface.kernel.h"
#include "lights/emission.kernel.h"

/// The triangle at the current moment, or at the previous one, for reuse from the frame before.
FN EmissiveTriangle emissive_triangle_at(uint moment, uint id) {
    if (feature(FEATURE_MOTION) && moment == MUTANT(PREVIOUS_EMITTERS_CURRENT, MOMENT_PREVIOUS, NONE)) {
        return load_previous_emissive_triangles(id);
    }
    return load_emissive_triangles(id);
}

/// Density per solid angle with which sample_emitter finds `point` from `reference`, if the light is picked with
/// probability `pmf`.
FN float pdf_emitter(IN(EmissiveTriangle) light, float pmf, vec3 reference, vec3 point) {
    PRECISE vec3 to_vertex_0 = light.vertex_0 - reference;
    TriangleView view = triangle_view(to_vertex_0, light.edge_1, light.edge_2, light.front, light.double_area);
    return pmf * pdf_triangle_view(view, point - reference);
}

/// The light that a surface is part of; NONE where it is no light.
FN uint light_of_surface(IN(Surface) s) {
    if (!feature(FEATURE_EMISSIVE) || s.emitter_slot == NONE) {
        return NONE;
    }
    uint first = load_emitter_slots(s.emitter_slot);
    return first == NONE ? NONE : first + s.primitive;
}

/// Whether `reference` sees the light's back or its edge.
FN bool is_behind(IN(EmissiveTriangle) light, vec3 reference) {
    return dot(light.vertex_0 - reference, light.front) >= 0.0f;
}

/// A point of the light, moved off its surface to the side that emits, or, if `behind`, to the other side.
FN vec3 emitter_end(IN(EmissiveTriangle) light, vec3 point, bool behind) {
    vec3 magnitude = abs(light.vertex_0) + abs(light.edge_1) + abs(light.edge_2);
    return offset_ray(point, behind ? -light.front : light.front, magnitude);
}

/// Samples a point of the light as seen from `reference` (triangle_sampling.h).
FN TriangleSample sample_emitter_point(IN(EmissiveTriangle) light, vec3 reference, vec2 u) {
    PRECISE vec3 to_vertex_0 = light.vertex_0 - reference;
    TriangleView view = triangle_view(to_vertex_0, light.edge_1, light.edge_2, light.front, light.double_area);
    return sample_triangle_view(view, to_vertex_0, light.edge_1, light.edge_2, u);
}

/// The light sample for a point of sample_emitter_point, if the light was picked with probability `pmf`.
FN LightSample sample_emitter(IN(EmissiveTriangle) light, float pmf, vec3 reference, IN(TriangleSample) t) {
    LightSample s = no_light();
    if (!(t.pdf > 0.0f)) {
        return s;
    }
    vec3 point = light.vertex_0 + t.barycentrics.x * light.edge_1 + t.barycentrics.y * light.edge_2;
    s.direction = normalize_or(point - reference, light.front);
    s.radiance = emitter_radiance(light, t.barycentrics);
    s.pdf = MUTANT(NO_LIGHT_PICK_PDF, pmf, 1.0f) * t.pdf;
    vec3 end = MUTANT(SHADOW_RAY_TO_WRONG_LIGHT, point, load_emissive_triangles(0u).vertex_0);
    s.end = emitter_end(light, end, is_behind(light, reference));
    return s;
}

/// Whether rays may pass through the emitter, because of its alpha.
FN bool may_be_passed(IN(EmissiveTriangle) light) {
    if (!feature(FEATURE_ALPHA) || !feature(FEATURE_EMISSIVE_TEXTURES) || (light.flags & EMITTER_VARIES) == 0u) {
        return false;
    }
    uint flags = load_materials(load_geometries(light.geometry).material).flags;
    return (flags & (MATERIAL_ALPHA_MASK | MATERIAL_ALPHA_BLEND)) != 0u;
}

FN SeenLight see_emitter(IN(EmissiveTriangle) light, vec2 barycentrics, vec3 reference) {
    SeenLight s = unseen_light();
    vec3 point = light.vertex_0 + barycentrics.x * light.edge_1 + barycentrics.y * light.edge_2;
    vec3 to_light = point - reference;
    float facing = -dot(light.front, to_light);
    float squared = dot(to_light, to_light);
    if (!(squared > 0.0f) || (facing <= 0.0f && (light.flags & EMITTER_TWO_SIDED) == 0u)) {
        return s;
    }
    float inverse = inversesqrt(squared);
    s.direction = to_light * inverse;
    s.measure = light.double_area * abs(facing) * inverse * inverse * inverse;
    s.radiance = emitter_radiance(light, barycentrics);
    s.by_chance = MUTANT(PASSABLE_BY_CHANCE, !may_be_passed(light), true);
    s.end = emitter_end(light, point, facing < 0.0f);
    return s;
}

#endif
