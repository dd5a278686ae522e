// Sampling points on a triangle x = v0 + b_1 e1 + b_2 e2 as seen from a reference point. Both faces count; the caller
// checks the facing.
#ifndef TRIANGLE_SAMPLING_H
#define TRIANGLE_SAMPLING_H

#include "numbers/elementary.h"

SHARED_BEGIN

CONST float SPHERICAL_TRIANGLE_MIN = 3e-4f;  // sr; smaller triangles look flat, and directions lose digits
CONST float SPHERICAL_TRIANGLE_MAX = 6.22f;  // sr; larger triangles are close to the half space and lose digits too
CONST float TAN_HALF_MIN = 1.5e-4f;      // tan(SPHERICAL_TRIANGLE_MIN / 2)
CONST float TAN_HALF_MAX = 0.0316032f;   // -tan(SPHERICAL_TRIANGLE_MAX / 2)

struct TriangleSample {
    vec2 barycentrics;  // of the second and third vertex
    float pdf;          // per solid angle; 0: no sample
};

/// Uniform by area (Heitz 2019, "A Low-Distortion Map Between Triangle and Square"). Returns barycentrics of the
/// second and third vertex, both >= 0, with a sum below 1 for u in [0, 1)^2.
FN vec2 sample_triangle(vec2 u) {
    if (u.y > u.x) {
        float half_x = 0.5f * u.x;
        return vec2(half_x, u.y - half_x);
    }
    float half_y = 0.5f * u.y;
    return vec2(u.x - half_y, half_y);
}

/// The triangle as seen from the reference point.
struct TriangleView {
    vec3 a;  // unit vectors to the vertices
    vec3 b;
    vec3 c;
    vec3 inverse_lengths;  // 1 over the distances to the vertices
    float height;          // from the reference point to the plane, along the normal
    float double_area;
    float volume;       // |det(a, b, c)|, computed from the edges: unit vectors would cancel
    float denominator;  // tan(solid angle / 2) = volume / denominator
    float edge_ab;      // 1 + a · b, a term of the denominator
};

FN float largest_magnitude(vec3 v) {
    return max_component(abs(v));
}

/// e1 x e2, computed from the two shortest edges, which loses the fewest digits for a needle.
FN vec3 triangle_cross(vec3 e1, vec3 e2) {
    PRECISE vec3 e3 = e2 - e1;
    float length_1 = dot(e1, e1);
    float length_2 = dot(e2, e2);
    float length_3 = dot(e3, e3);
    bool first_longest = length_1 >= length_2 && length_1 >= length_3;
    bool second_longest = !first_longest && length_2 >= length_3;
    vec3 p = first_longest ? e2 : e1;
    vec3 q = first_longest || second_longest ? e3 : e2;
    PRECISE vec3 n = vec3(p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x);
    return n;
}

/// Solid angle of the triangle (Van Oosterom and Strackee 1983), as the tangent of its half. `to_vertex_0` is from the
/// reference point. `normal` is unit, of either side. `double_area` = |e1 x e2|. Distances must be between 1e-18 and
/// 1e18.
FN TriangleView triangle_view(vec3 to_vertex_0, vec3 e1, vec3 e2, vec3 normal, float double_area) {
    TriangleView view;
    PRECISE vec3 b = to_vertex_0 + e1;
    PRECISE vec3 c = to_vertex_0 + e2;
    float inverse_a = inversesqrt(dot(to_vertex_0, to_vertex_0));
    float inverse_b = inversesqrt(dot(b, b));
    float inverse_c = inversesqrt(dot(c, c));
    view.a = to_vertex_0 * inverse_a;
    view.b = b * inverse_b;
    view.c = c * inverse_c;
    PRECISE float height = to_vertex_0.x * normal.x + to_vertex_0.y * normal.y + to_vertex_0.z * normal.z;
    PRECISE float edge_ab = 1.0f + dot(view.a, view.b);
    PRECISE float denominator = edge_ab + dot(view.a, view.c) + dot(view.b, view.c);
    view.inverse_lengths = vec3(inverse_a, inverse_b, inverse_c);
    view.height = height;
    view.double_area = double_area;
    view.volume = MUTANT(SOLID_ANGLE_BY_UNIT_VECTORS, (abs(height) * inverse_a) * (double_area * inverse_b * inverse_c),
                         abs(dot(view.a, cross(view.b, view.c))));
    view.denominator = denominator;
    view.edge_ab = edge_ab;
    return view;
}

FN float view_solid_angle(IN(TriangleView) view) {
    return 2.0f * arctan2(view.volume, view.denominator);
}

/// Whether the solid angle lies between SPHERICAL_TRIANGLE_MIN and SPHERICAL_TRIANGLE_MAX, by the tangent of its half.
FN bool samples_spherically(IN(TriangleView) view) {
    float bound = view.denominator >= 0.0f ? TAN_HALF_MIN : TAN_HALF_MAX;
    return view.volume >= bound * abs(view.denominator) && view.volume > 0.0f;
}

/// Density per solid angle of a point that is uniform by area: r^2/(A |cos|) with |cos| = |height|/r.
FN float pdf_triangle_area_solid_angle(IN(TriangleView) view, vec3 to_point) {
    float height = abs(view.height);
    float r_squared = dot(to_point, to_point);
    if (!(height > 1e-37f && view.double_area > 1e-37f)) {
        return 0.0f;
    }
    float pdf = MUTANT(NO_AREA_JACOBIAN, 2.0f * (r_squared / view.double_area) * (sqrt(r_squared) / height),
                       2.0f / view.double_area);
    return min(pdf, 8.0e37f);
}

/// The density of sample_triangle_view at a point of the triangle, per solid angle.
FN float pdf_triangle_view(IN(TriangleView) view, vec3 to_point) {
    if (samples_spherically(view)) {
        return 1.0f / view_solid_angle(view);
    }
    return pdf_triangle_area_solid_angle(view, to_point);
}

/// Barycentrics of the second and third vertex of a point that is uniform over the spherical triangle (Arvo 1995,
/// "Stratified Sampling of Spherical Triangles"). C' on the arc AC is such that ABC' has the share u.x of the area;
/// the point lies on the arc BC'. Directions are weights of the unit vectors A, B, C, computed without cancellation.
/// The half vector of A and C' is o = p A + q C, up to length (Peters 2021, "BRDF Importance Sampling for Polygonal
/// Lights"), so C' = (p^2 - q^2)/o^2 A + 2 q (A·o)/o^2 C. The arc t from B satisfies sin^2(t/2) = u.y sin^2(BC'/2).
FN vec2 sample_spherical_triangle(IN(TriangleView) view, float solid_angle, vec2 u) {
    float s;
    float co;
    sin_cos(0.5f * u.x * solid_angle, s, co);
    float rest = max(view.volume * co - view.denominator * s, 0.0f);
    float toward_c = max(view.edge_ab * s, 0.0f);
    float both_parts = rest + toward_c;
    vec3 half_vector = both_parts * view.a + toward_c * view.c;
    float inverse_squared = 1.0f / max(dot(half_vector, half_vector), 1e-36f);
    float share_a = rest * (both_parts + toward_c) * inverse_squared;
    float share_c = 2.0f * toward_c * dot(view.a, half_vector) * inverse_squared;
    vec3 c_new = share_a * view.a + share_c * view.c;
    vec3 chord = c_new - view.b;
    vec3 both = c_new + view.b;
    float sine_squared = 0.25f * dot(chord, chord);  // of half the arc BC'
    float cosine_squared = 0.25f * dot(both, both);
    float sampled = u.y * sine_squared;
    float share_new = sqrt(u.y * max(1.0f - sampled, 0.0f) / max(cosine_squared, 1e-20f));
    float share_b = 1.0f - 2.0f * sampled - share_new * (cosine_squared - sine_squared);
    // Projection onto the flat triangle divides a vertex's weight by its distance.
    float weight_a = share_new * share_a * view.inverse_lengths.x;
    float weight_b = max(share_b, 0.0f) * view.inverse_lengths.y;
    float weight_c = share_new * share_c * view.inverse_lengths.z;
    float sum = weight_a + weight_b + weight_c;
    float to_barycentric = sum > 0.0f ? 1.0f / sum : 0.0f;
    float b_1 = min(weight_b * to_barycentric, 1.0f);
    return vec2(b_1, min(weight_c * to_barycentric, 1.0f - b_1));
}

/// Samples a point on the triangle; `to_vertex_0` is from the reference point. It is uniform by solid angle where that
/// is between SPHERICAL_TRIANGLE_MIN and SPHERICAL_TRIANGLE_MAX, else by area. The pdf is 0 for a degenerate triangle
/// and for a reference point in its plane.
FN TriangleSample sample_triangle_view(IN(TriangleView) view, vec3 to_vertex_0, vec3 e1, vec3 e2, vec2 u) {
    TriangleSample result;
    if (samples_spherically(view)) {
        float solid_angle = view_solid_angle(view);
        result.barycentrics = sample_spherical_triangle(view, solid_angle, u);
        result.pdf = 1.0f / solid_angle;
        return result;
    }
    result.barycentrics = sample_triangle(u);
    vec3 to_point = to_vertex_0 + result.barycentrics.x * e1 + result.barycentrics.y * e2;
    result.pdf = pdf_triangle_area_solid_angle(view, to_point);
    return result;
}

// The same for a triangle at any scale, of which only the edges are known.

/// A power of two that scales the triangle's largest coordinate, relative to the reference point, into (1/4, 1).
FN float triangle_scale(vec3 to_vertex_0, vec3 e1, vec3 e2) {
    float extent = max(largest_magnitude(to_vertex_0), max(largest_magnitude(e1), largest_magnitude(e2)));
    return uintBitsToFloat((253u - min(floatBitsToUint(extent) >> 23, 252u)) << 23);
}

/// Edges as scaled by triangle_scale.
FN TriangleView triangle_view_of_edges(vec3 to_vertex_0, vec3 e1, vec3 e2) {
    vec3 n = triangle_cross(e1, e2);
    float double_area = length(n);
    return triangle_view(to_vertex_0, e1, e2, n * (1.0f / max(double_area, 1e-30f)), double_area);
}

/// In [0, 2 pi]; 0 for a degenerate triangle, and from a point in its plane but outside it.
FN float solid_angle_triangle(vec3 reference, vec3 v0, vec3 e1, vec3 e2) {
    PRECISE vec3 a = v0 - reference;
    float scale = triangle_scale(a, e1, e2);
    TriangleView view = triangle_view_of_edges(a * scale, e1 * scale, e2 * scale);
    return view_solid_angle(view);
}

FN TriangleSample sample_triangle_solid_angle(vec3 reference, vec3 v0, vec3 e1, vec3 e2, vec2 u) {
    PRECISE vec3 a = v0 - reference;
    float scale = triangle_scale(a, e1, e2);
    TriangleView view = triangle_view_of_edges(a * scale, e1 * scale, e2 * scale);
    return sample_triangle_view(view, a * scale, e1 * scale, e2 * scale, u);
}

/// The density of sample_triangle_solid_angle at this point of the triangle, from the same reference point.
FN float pdf_triangle_solid_angle(vec3 reference, vec3 v0, vec3 e1, vec3 e2, vec3 point_on_triangle) {
    PRECISE vec3 a = v0 - reference;
    float scale = triangle_scale(a, e1, e2);
    TriangleView view = triangle_view_of_edges(a * scale, e1 * scale, e2 * scale);
    return pdf_triangle_view(view, (point_on_triangle - reference) * scale);
}

SHARED_END

#endif
