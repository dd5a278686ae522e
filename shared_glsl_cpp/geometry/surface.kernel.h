// Computes the surface to shade from a hit's ids and the ray.
#ifndef SURFACE_KERNEL_H
#define SURFACE_KERNEL_H

#include "geometry/texture.kernel.h"

/// A hit in world space, recomputed by load_surface from the hit's ids and the ray that found it, with the origin of
/// rays that leave it (Wächter and Binder 2019).
struct Surface {
    vec3 position;
    vec3 normal;       // geometric, unit, of the front face
    vec3 start;        // `position` moved away from the triangle's edges; input of offset_ray
    vec3 magnitude;    // of the terms that `position` was summed from; input of offset_ray
    MeshPoint mesh;
    uint instance;
    uint emitter_slot; // index into emitter_slots; NONE where the instance emits nothing
    uint primitive;
};

FN vec3 transform_vector(IN(Instance) i, vec3 v) {
    PRECISE vec3 w = vec3(i.row_0.x * v.x + i.row_0.y * v.y + i.row_0.z * v.z,
                          i.row_1.x * v.x + i.row_1.y * v.y + i.row_1.z * v.z,
                          i.row_2.x * v.x + i.row_2.y * v.y + i.row_2.z * v.z);
    return w;
}

/// Bounds the terms of transform_point for points whose coordinates are at most `size`.
FN vec3 transform_magnitude(IN(Instance) i, vec3 size) {
    return vec3(dot(abs(xyz(i.row_0)), size) + abs(i.row_0.w), dot(abs(xyz(i.row_1)), size) + abs(i.row_1.w),
                dot(abs(xyz(i.row_2)), size) + abs(i.row_2.w));
}

FN vec3 transform_point(IN(Instance) i, vec3 p) {
    PRECISE vec3 q = transform_vector(i, p) + vec3(i.row_0.w, i.row_1.w, i.row_2.w);
    return q;
}

/// Transforms a normal by the cofactor matrix, which is the inverse transpose up to a factor. The sign of the factor
/// is corrected for a mirrored instance.
FN vec3 transform_normal(IN(Instance) i, vec3 n) {
    vec3 r0 = xyz(i.row_0);
    vec3 r1 = xyz(i.row_1);
    vec3 r2 = xyz(i.row_2);
    vec3 m = vec3(dot(cross(r1, r2), n), dot(cross(r2, r0), n), dot(cross(r0, r1), n));
    m = MUTANT(NORMAL_AS_VECTOR, m, transform_vector(i, n));
    return i.mirrored != 0u ? -m : m;
}

/// a x b, without contraction into fused multiply-adds, so that a 0 on one backend is a 0 on the other.
FN vec3 exact_cross(vec3 a, vec3 b) {
    PRECISE vec3 n = vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
    return n;
}

/// v / |v|, or `fallback` where v has no direction.
FN vec3 normalize_or(vec3 v, vec3 fallback) {
    float squared = dot(v, v);
    if (squared > 1e-30f && squared < 1e30f) {
        return v * inversesqrt(squared);
    }
    float scale = max(max(abs(v.x), abs(v.y)), abs(v.z));
    if (!(scale > 1e-37f && scale < INFINITE_DISTANCE)) {
        return fallback;
    }
    vec3 w = v * (1.0f / scale);
    return w * inversesqrt(dot(w, w));
}

/// Where a ray meets a triangle, as barycentrics of the second and third vertex, clamped to the triangle (Möller and
/// Trumbore 1997). Returns `fallback` where the ray is parallel to the triangle.
FN vec2 meet_triangle(vec3 origin, vec3 direction, vec3 vertex, vec3 edge_1, vec3 edge_2, vec2 fallback) {
    vec3 p = exact_cross(direction, edge_2);
    PRECISE vec3 from_vertex = origin - vertex;
    vec3 q = exact_cross(from_vertex, edge_1);
    PRECISE float determinant = edge_1.x * p.x + edge_1.y * p.y + edge_1.z * p.z;
    PRECISE float u = from_vertex.x * p.x + from_vertex.y * p.y + from_vertex.z * p.z;
    PRECISE float v = direction.x * q.x + direction.y * q.y + direction.z * q.z;
    if (!(abs(determinant) > 0.0f)) {
        return fallback;
    }
    PRECISE float inverse = 1.0f / determinant;
    PRECISE vec2 inside = vec2(max(u * inverse, 0.0f), max(v * inverse, 0.0f));
    PRECISE float sum = inside.x + inside.y;
    PRECISE vec2 met = inside * (1.0f / max(sum, 1.0f));
    return met;
}

/// The surface where a ray from `origin` along `direction` met `hit`. Each intersector rounds the intersection
/// differently. It is therefore recomputed here from the ray, so that the same ray meets the same point on every
/// backend.
FN Surface load_surface(IN(Hit) hit, IN(Instance) instance, vec3 origin, vec3 direction) {
    Surface s;
    LOCAL(Geometry) g = load_geometries(instance.first_geometry + hit.geometry);
    uvec3 triangle = load_triangles(g.first_triangle + hit.primitive);
    vec3 a = load_positions(g.first_vertex + triangle.x);
    vec3 b = load_positions(g.first_vertex + triangle.y);
    vec3 c = load_positions(g.first_vertex + triangle.z);
    vec3 edge_1 = transform_vector(instance, b - a);
    vec3 edge_2 = transform_vector(instance, c - a);
    vec2 barycentrics =
        meet_triangle(origin, direction, transform_point(instance, a), edge_1, edge_2, hit.barycentrics);
    s.mesh = mesh_point(g, hit.primitive, barycentrics);
    PRECISE vec3 local = a + barycentrics.x * (b - a) + barycentrics.y * (c - a);
    s.position = transform_point(instance, local);
    vec2 kept = off_edges(barycentrics);
    PRECISE vec3 start = s.position + (kept.x - barycentrics.x) * edge_1 + (kept.y - barycentrics.y) * edge_2;
    s.start = start;
    s.magnitude = transform_magnitude(instance, max(abs(a), max(abs(b), abs(c))));
    vec3 n = exact_cross(edge_1, edge_2);
    s.normal = normalize_or(instance.mirrored != 0u ? -n : n, -direction);
    s.instance = hit.instance;
    s.primitive = hit.primitive;
    s.emitter_slot =
        instance.first_emitter_slot == NONE ? NONE : instance.first_emitter_slot + hit.geometry;
    return s;
}

/// The interpolated normal, on the front side; the geometric normal where the mesh has no normals.
FN vec3 interpolated_normal(IN(Surface) s, IN(Instance) instance) {
    uint first = s.mesh.geometry.first_normal;
    if (first == NONE) {
        return s.normal;
    }
    vec3 a = load_normals(first + s.mesh.triangle.x);
    vec3 b = load_normals(first + s.mesh.triangle.y);
    vec3 c = load_normals(first + s.mesh.triangle.z);
    vec3 n = interpolate(s.mesh, a, b, c);
    return normalize_or(transform_normal(instance, n), s.normal);
}

/// The normal that a normal map gives about `normal`; `normal` itself where the mesh has no usable tangent.
FN vec3 mapped_normal(IN(Surface) s, IN(Instance) instance, IN(Material) material, vec3 normal) {
    uint first = s.mesh.geometry.first_tangent;
    if (first == NONE) {
        return normal;
    }
    vec4 a = load_tangents(first + s.mesh.triangle.x);
    vec4 b = load_tangents(first + s.mesh.triangle.y);
    vec4 c = load_tangents(first + s.mesh.triangle.z);
    vec4 t = interpolate(s.mesh, a, b, c);
    vec3 along = normalize_or(transform_vector(instance, xyz(t)), normal);
    vec3 across = along - dot(along, normal) * normal;
    if (!(dot(across, across) > TANGENT_SINE * TANGENT_SINE)) {
        return normal;
    }
    vec3 tangent = normalize_or(across, normal);
    bool mirrored = MUTANT(HANDEDNESS_NOT_MIRRORED, instance.mirrored != 0u, false);
    float handedness = (MUTANT(HANDEDNESS_OF_A_CORNER, t.w, a.w) < 0.0f) != mirrored ? -1.0f : 1.0f;
    vec3 bitangent = cross(normal, tangent) * handedness;
    vec3 m = xyz(slot_value(material.normal_slot, s.mesh)) * 2.0f - vec3(1.0f, 1.0f, 1.0f);
    vec2 scaled = material.normal_scale * vec2(m.x, m.y);
    vec3 n = scaled.x * tangent + MUTANT(NORMAL_SCALE_OF_X, scaled.y, m.y) * bitangent + m.z * normal;
    return normalize_or(n, normal);
}

/// The BSDF of a surface seen from `wo`. All its normals are on wo's side.
FN SurfaceBsdf load_bsdf(IN(Surface) s, IN(Instance) instance, IN(Material) material, vec3 wo) {
    SurfaceBsdf bsdf;
    vec3 base = xyz(base_color(material, s.mesh));
    vec4 metallic_roughness = slot_value(material.metallic_roughness_slot, s.mesh);
    vec4 specular_factor = slot_value(material.specular_slot, s.mesh);
    float specular = material.specular * MUTANT(SPECULAR_OF_RED, specular_factor.w, specular_factor.x);
    vec3 specular_color = material.specular_color * xyz(slot_value(material.specular_color_slot, s.mesh));
    bsdf.parameters =
        bsdf_parameters(base, material.metallic * MUTANT(METALLIC_OF_RED, metallic_roughness.z, metallic_roughness.x),
                        material.roughness * MUTANT(ROUGHNESS_OF_BLUE, metallic_roughness.y, metallic_roughness.z),
                        material.f0, specular, specular_color, constants.brdf);
    vec3 smooth_normal = interpolated_normal(s, instance);
    vec3 bumped = smooth_normal;
    bsdf.mapped = NORMAL_MAP_NONE;
    if (feature(FEATURE_NORMAL_MAPS) && material.normal_slot != NONE) {
        bumped = mapped_normal(s, instance, material, smooth_normal);
        bsdf.mapped = normal_map_model(constants.normal_maps, smooth_normal, bumped);
    }
    float side = dot(s.normal, wo) < 0.0f ? -1.0f : 1.0f;
    bsdf.geometric_normal = side * s.normal;
    float smooth_side = dot(smooth_normal, bsdf.geometric_normal) < 0.0f ? -1.0f : 1.0f;
    bsdf.shading_normal = smooth_side * smooth_normal;
    bsdf.mapped_normal = smooth_side * bumped;
    return bsdf;
}

#endif
