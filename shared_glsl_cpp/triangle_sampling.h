// Points on a triangle x = v0 + b_1 e1 + b_2 e2, seen from a reference point. Both faces count: facing is the caller's
// to check.
#ifndef TRIANGLE_SAMPLING_H
#define TRIANGLE_SAMPLING_H

#include "elementary.h"

SHARED_BEGIN

CONST float SPHERICAL_TRIANGLE_MIN = 3e-4f;  // sr; smaller ones look flat, and directions lose digits
CONST float SPHERICAL_TRIANGLE_MAX = 6.22f;  // sr; larger ones, close to the half space, lose digits too
CONST float TAN_HALF_MIN = 1.5e-4f;      // tan(SPHERICAL_TRIANGLE_MIN / 2)
CONST float TAN_HALF_MAX = 0.0316032f;   // -tan(SPHERICAL_TRIANGLE_MAX / 2)

struct TriangleSample {
    vec2 barycentrics;  // of the second and third vertex
    float pdf;          // by solid angle; 0: no sample
};

/// Uniform by area: barycentrics of the second and third vertex, both >= 0 with a sum below 1 for u in [0, 1)^2.
/// Heitz 2019, "A Low-Distortion Map Between Triangle and Square".
FN vec2 sample_triangle(vec2 u) {
    if (u.y > u.x) {
        float half_x = 0.5f * u.x;
        return vec2(half_x, u.y - half_x);
    }
    float half_y = 0.5f * u.y;
    return vec2(u.x - half_y, half_y);
}

/// The triangle as seen from the reference point, scaled so that no coordinate passes 1: pdfs and angles do not change.
struct TriangleView {
    vec3 a;  // to the vertices
    vec3 b;
    vec3 c;
    vec3 e1;
    vec3 e2;
    float volume;  // a . (e1 x e2): six times that of the tetrahedron, signed
    float denominator;  // tan(solid angle / 2) = |volume| / denominator
    float edge_ab;      // the denominator's part |a||b||c| + (a . b)|c|
    vec3 lengths;       // of a, b, c
    float scale;
};

FN float largest_magnitude(vec3 v) {
    return max_component(abs(v));
}

/// e1 x e2 by the two shortest edges, which loses fewest digits on a needle.
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

/// Solid angle by Van Oosterom & Strackee 1983, with the numerator from the edges: unit vectors would cancel.
FN TriangleView triangle_view(vec3 reference, vec3 v0, vec3 e1, vec3 e2) {
    TriangleView view;
    PRECISE vec3 a = v0 - reference;
    float extent = max(largest_magnitude(a), max(largest_magnitude(e1), largest_magnitude(e2)));
    // A power of two, so that edges which nearly cancel keep their difference.
    float scale = uintBitsToFloat((253u - min(floatBitsToUint(extent) >> 23, 252u)) << 23);
    view.scale = scale;
    view.a = a * scale;
    view.e1 = e1 * scale;
    view.e2 = e2 * scale;
    PRECISE vec3 b = view.a + view.e1;
    PRECISE vec3 c = view.a + view.e2;
    view.b = b;
    view.c = c;
    vec3 n = triangle_cross(view.e1, view.e2);
    PRECISE float volume = view.a.x * n.x + view.a.y * n.y + view.a.z * n.z;
    float length_a = length(view.a);
    float length_b = length(b);
    float length_c = length(c);
    PRECISE float edge_ab = length_a * length_b * length_c + dot(view.a, b) * length_c;
    PRECISE float denominator = edge_ab + dot(view.a, c) * length_b + dot(b, c) * length_a;
    view.volume = volume;
    view.denominator = denominator;
    view.edge_ab = edge_ab;
    view.lengths = vec3(length_a, length_b, length_c);
    return view;
}

FN float view_solid_angle(IN(TriangleView) view) {
    return 2.0f * arctan2(abs(view.volume), view.denominator);
}

/// Whether the solid angle lies between SPHERICAL_TRIANGLE_MIN and _MAX, by its tangent.
FN bool samples_spherically(IN(TriangleView) view) {
    float bound = view.denominator >= 0.0f ? TAN_HALF_MIN : TAN_HALF_MAX;
    return abs(view.volume) >= bound * abs(view.denominator) && abs(view.volume) > 0.0f;
}

/// In [0, 2 pi]; 0 for a degenerate triangle and from within its plane, outside it.
FN float solid_angle_triangle(vec3 reference, vec3 v0, vec3 e1, vec3 e2) {
    TriangleView view = triangle_view(reference, v0, e1, e2);
    return view_solid_angle(view);
}

/// Uniform by area, by solid angle: r^2/(A |cos|), where |cos| A = |a . n|/(2 r). `to_point` in the view's scale.
FN float pdf_triangle_area_solid_angle(IN(TriangleView) view, vec3 to_point) {
    float height = abs(view.volume);
    float r_squared = dot(to_point, to_point);
    if (!(height > 1e-30f)) {
        return 0.0f;
    }
    float pdf = MUTANT(NO_AREA_JACOBIAN, 2.0f * r_squared * sqrt(r_squared) / height,
                       2.0f / length(triangle_cross(view.e1, view.e2)));
    return min(pdf, 8.0e37f);
}

/// The pdf that sample_triangle_solid_angle has for this point of the triangle, from the same reference point.
FN float pdf_triangle_solid_angle(vec3 reference, vec3 v0, vec3 e1, vec3 e2, vec3 point_on_triangle) {
    TriangleView view = triangle_view(reference, v0, e1, e2);
    if (samples_spherically(view)) {
        return 1.0f / view_solid_angle(view);
    }
    return pdf_triangle_area_solid_angle(view, (point_on_triangle - reference) * view.scale);
}

/// Barycentrics of the second and third vertex, uniform over the spherical triangle. The map is Arvo's (1995, "Stratified Sampling
/// of Spherical Triangles"): C' on the arc AC so that ABC' has the share u.x of the area, then a point on the arc BC'. Directions
/// are kept as weights of the unit vectors A, B, C, in differences that cannot cancel: with o the half vector of A and C', which is
/// A + r C in some length (Peters 2021, "BRDF Importance Sampling for Polygonal Lights"), C' = (1 - r^2)/o^2 A + ..., and
/// sin^2(t/2) = u.y sin^2(BC'/2) for the arc t from B.
FN vec2 sample_spherical_triangle(IN(TriangleView) view, float solid_angle, vec2 u) {
    vec3 inverse = vec3(1.0f / view.lengths.x, 1.0f / view.lengths.y, 1.0f / view.lengths.z);
    vec3 a = view.a * inverse.x;
    vec3 b = view.b * inverse.y;
    vec3 c = view.c * inverse.z;
    float s;
    float co;
    sin_cos(0.5f * u.x * solid_angle, s, co);
    float rest = max(abs(view.volume) * co - view.denominator * s, 0.0f);
    float toward_c = max(view.edge_ab * s, 0.0f);
    float scale = 1.0f / max(rest + toward_c, 1e-30f);
    float r = toward_c * scale;
    vec3 half_vector = a + r * c;
    float share_a = rest * scale * (1.0f + r) / max(dot(half_vector, half_vector), 1e-20f);
    float share_c = (1.0f + share_a) * r;
    vec3 c_new = share_a * a + share_c * c;
    vec3 chord = c_new - b;
    vec3 both = c_new + b;
    float sine_squared = 0.25f * dot(chord, chord);  // of half the arc BC'
    float cosine_squared = 0.25f * dot(both, both);
    float sampled = u.y * sine_squared;
    float share_new = sqrt(u.y * max(1.0f - sampled, 0.0f) / max(cosine_squared, 1e-20f));
    float share_b = 1.0f - 2.0f * sampled - share_new * (cosine_squared - sine_squared);
    // On the flat triangle a vertex's weight falls with its distance.
    float weight_a = share_new * share_a * inverse.x;
    float weight_b = max(share_b, 0.0f) * inverse.y;
    float weight_c = share_new * share_c * inverse.z;
    float sum = weight_a + weight_b + weight_c;
    float to_barycentric = sum > 0.0f ? 1.0f / sum : 0.0f;
    float b_1 = min(weight_b * to_barycentric, 1.0f);
    return vec2(b_1, min(weight_c * to_barycentric, 1.0f - b_1));
}

/// A point on the triangle: by solid angle where that is between SPHERICAL_TRIANGLE_MIN and _MAX, else by area. pdf 0
/// for degenerate triangles and from within the plane.
FN TriangleSample sample_triangle_solid_angle(vec3 reference, vec3 v0, vec3 e1, vec3 e2, vec2 u) {
    TriangleView view = triangle_view(reference, v0, e1, e2);
    TriangleSample result;
    if (samples_spherically(view)) {
        float solid_angle = view_solid_angle(view);
        result.barycentrics = sample_spherical_triangle(view, solid_angle, u);
        result.pdf = 1.0f / solid_angle;
        return result;
    }
    result.barycentrics = sample_triangle(u);
    vec3 to_point = view.a + result.barycentrics.x * view.e1 + result.barycentrics.y * view.e2;
    result.pdf = pdf_triangle_area_solid_angle(view, to_point);
    return result;
}

SHARED_END

#endif
