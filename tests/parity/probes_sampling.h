// Probes of warps, frames, triangles, weights, cameras, environment maps, ray offsets and tone maps.
#ifndef PROBES_SAMPLING_H
#define PROBES_SAMPLING_H

#include "probe.h"

SHARED_BEGIN

FN void probe_disk(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    vec2 u = vec2(p.u.x, p.u.y);
    float radius;
    vec2 disk = sample_disk_concentric(u, radius);
    put_bits(o, floatBitsToUint(radius));
    put(o, disk.x, abs(radius));
    put(o, disk.y, abs(radius));
}

FN void probe_hemispheres(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    vec2 u = vec2(p.u.x, p.u.y);
    put3(o, sample_cosine_hemisphere(u), 1.0f);
    put3(o, sample_uniform_hemisphere(u), 1.0f);
    put3(o, sample_uniform_sphere(u), 1.0f);
    put_relative(o, pdf_cosine_hemisphere_solid_angle(p.axis.z));
    put_relative(o, pdf_uniform_hemisphere_solid_angle());
    put_relative(o, pdf_uniform_sphere_solid_angle());
}

FN void probe_frame(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    Frame frame = frame_from_normal(p.axis);
    put3(o, frame.tangent, 1.0f);
    put3(o, frame.bitangent, 1.0f);
    put_same3(o, frame.normal);
    put3(o, to_local(frame, p.axis_2), 1.0f);
    put3(o, to_world(frame, p.axis_2), 1.0f);
}

FN void probe_triangle_by_area(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    vec2 b = sample_triangle(vec2(p.u.x, p.u.y));
    put_bits(o, floatBitsToUint(b.x));
    put_bits(o, floatBitsToUint(b.y));
    vec3 e3 = p.edge_2 - p.edge_1;
    float l1 = length(p.edge_1);
    float l2 = length(p.edge_2);
    float l3 = length(e3);
    float longest = max(l1, max(l2, l3));
    // Whichever two edges are the shorter, their product over the longest is what rounding is worth.
    put3(o, triangle_cross(p.edge_1, p.edge_2), l1 * l2 * l3 / max(longest, 1.0e-30f));
}

/// The triangle, seen from the origin, as solid_angle_triangle scales it.
struct ProbeTriangle {
    vec3 vertex;
    vec3 edge_1;
    vec3 edge_2;
    TriangleView view;
};

FN ProbeTriangle probe_triangle(IN(ProbeInput) p) {
    float scale = triangle_scale(p.vertex, p.edge_1, p.edge_2);
    ProbeTriangle t;
    t.vertex = p.vertex * scale;
    t.edge_1 = p.edge_1 * scale;
    t.edge_2 = p.edge_2 * scale;
    t.view = triangle_view_of_edges(t.vertex, t.edge_1, t.edge_2);
    return t;
}

/// How much the view's volume and its angle move where coordinates do by an ulp of the distance.
FN float probe_volume_scale(IN(ProbeTriangle) t) {
    vec3 e3 = t.edge_2 - t.edge_1;
    float l1 = length(t.edge_1);
    float l2 = length(t.edge_2);
    float l3 = length(e3);
    float edges = l1 * l2 * l3 / max(max(l1, max(l2, l3)), 1.0e-30f);
    return edges * t.view.inverse_lengths.y * t.view.inverse_lengths.z;
}

FN float probe_angle_scale(IN(ProbeTriangle) t) {
    float volume = t.view.volume;
    float square = volume * volume + t.view.denominator * t.view.denominator;
    float slope = abs(t.view.denominator) * probe_volume_scale(t) + volume;
    return view_solid_angle(t.view) + slope / max(square, 1.0e-35f);
}

/// How much of its digits a point of the triangle loses where its parts cancel.
FN float probe_cancelled(IN(ProbeTriangle) t, vec2 b) {
    vec3 point = t.vertex + b.x * t.edge_1 + b.y * t.edge_2;
    return (length(t.vertex) + length(t.edge_1) + length(t.edge_2)) / max(length(point), 1.0e-20f);
}

FN void probe_triangle_view(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    vec3 reference = vec3(0.0f, 0.0f, 0.0f);
    ProbeTriangle t = probe_triangle(p);
    put_bits(o, floatBitsToUint(triangle_scale(p.vertex, p.edge_1, p.edge_2)));
    put3(o, t.view.a, 1.0f);
    put3(o, t.view.b, 1.0f);
    put3(o, t.view.c, 1.0f);
    put(o, t.view.volume, probe_volume_scale(t));
    put(o, t.view.denominator, 1.0f);
    put(o, t.view.edge_ab, 1.0f);
    put_relative(o, t.view.inverse_lengths.x);
    put_path(o, samples_spherically(t.view));
    put(o, view_solid_angle(t.view), probe_angle_scale(t));
    put(o, solid_angle_triangle(reference, p.vertex, p.edge_1, p.edge_2), probe_angle_scale(t));
    TriangleView of_normal = triangle_view(t.vertex, t.edge_1, t.edge_2, p.axis, 1.0f);
    put(o, of_normal.height, 1.0f);
}

FN void probe_triangle_pdf(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    vec3 reference = vec3(0.0f, 0.0f, 0.0f);
    ProbeTriangle t = probe_triangle(p);
    bool spherical = samples_spherically(t.view);
    put_path(o, spherical);
    vec2 b = sample_triangle(vec2(p.u.x, p.u.y));
    vec3 point = p.vertex + b.x * p.edge_1 + b.y * p.edge_2;
    float by_area = probe_cancelled(t, b) + probe_volume_scale(t) / max(t.view.volume, 1.0e-30f);
    float by_angle = probe_angle_scale(t) / max(view_solid_angle(t.view), 1.0e-30f);
    float pdf = pdf_triangle_solid_angle(reference, p.vertex, p.edge_1, p.edge_2, point);
    put(o, pdf, pdf * (spherical ? by_angle : by_area));
    vec3 scaled = t.vertex + b.x * t.edge_1 + b.y * t.edge_2;
    float pdf_of_view = pdf_triangle_view(t.view, scaled);
    put(o, pdf_of_view, pdf_of_view * (spherical ? by_angle : by_area));
    float area_pdf = pdf_triangle_area_solid_angle(t.view, scaled);
    put(o, area_pdf, area_pdf * by_area);
    TriangleSample s = sample_triangle_solid_angle(reference, p.vertex, p.edge_1, p.edge_2, vec2(p.u.x, p.u.y));
    put(o, s.pdf, s.pdf * (spherical ? by_angle : by_area + probe_cancelled(t, s.barycentrics)));
}

/// By solid angle: the direction, as barycentrics of far triangles move more than what they stand for.
FN void probe_triangle_by_angle(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    ProbeTriangle t = probe_triangle(p);
    bool spherical = samples_spherically(t.view);
    put_path(o, spherical);
    if (!spherical) {
        return;
    }
    float angle = view_solid_angle(t.view);
    vec2 u = vec2(p.u.x, p.u.y);
    vec2 b = sample_spherical_triangle(t.view, angle, u);
    TriangleSample s = sample_triangle_view(t.view, t.vertex, t.edge_1, t.edge_2, u);
    float scale = 1.0f + probe_angle_scale(t) / angle;
    put3(o, normalize(t.vertex + b.x * t.edge_1 + b.y * t.edge_2), scale);
    put3(o, normalize(t.vertex + s.barycentrics.x * t.edge_1 + s.barycentrics.y * t.edge_2), scale);
}

FN void probe_mis(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    put_relative(o, mis_weight(MIS_POWER, abs(p.number), abs(p.other)));
    put_relative(o, mis_weight(MIS_BALANCE, abs(p.number), abs(p.other)));
    put_relative(o, mis_weight(MIS_POWER, p.u.x, p.u.y));
    put_relative(o, mis_weight(MIS_BALANCE, p.special, p.u.y));
    put_relative(o, mis_weight(MIS_POWER, p.u.y, p.special));
}

FN void probe_camera(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    Camera camera;
    camera.origin = p.vertex;
    camera.kind = p.words.x % 4u == 0u ? CAMERA_ORTHOGRAPHIC : CAMERA_PERSPECTIVE;
    camera.right = 0.7f * p.axis_2;
    camera.lens_radius = 0.1f * p.u.z;
    camera.up = p.wi;
    camera.focus_distance = 0.5f + p.u.w;
    camera.forward = p.axis;
    vec3 origin;
    vec3 direction;
    camera_ray(camera, vec2(p.u.x, p.u.y), vec2(p.u.z, p.u.w), p.words.y % 2u == 0u, p.words.z % 8u != 0u, origin,
               direction);
    put3(o, origin, 2.0f + length(p.vertex));
    vec3 toward = p.axis + (2.0f * p.u.x - 1.0f) * camera.right + (1.0f - 2.0f * p.u.y) * camera.up;
    put3(o, direction, 1.0f + 3.0f / max(length(toward) - 0.2f, 1.0e-3f));
}

FN void probe_environment(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    vec2 rotation = vec2(p.u.z - 0.5f, 0.25f + p.u.w);  // not unit, but the same bits everywhere
    vec2 uv = environment_uv(p.axis, rotation);
    // u jumps from 1 to 0 along the seam; its distance to the map's centre does not.
    put(o, abs(uv.x - 0.5f), 1.0f);
    put(o, uv.y, 1.0f);
    put3(o, environment_direction(vec2(p.u.x, p.u.y), rotation), 1.5f);
    put_relative(o, pdf_environment_solid_angle(p.u.z, p.set, p.axis.z));
}

FN void probe_ray_offset(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    put_same3(o, offset_ray(p.vertex, p.axis, abs(p.vertex) + abs(p.edge_2)));
    put_same3(o, offset_ray(p.edge_1, p.axis_2, abs(p.edge_1)));
    vec2 kept = off_edges(sample_triangle(vec2(p.u.x, p.u.y)));
    vec2 pushed = off_edges(vec2(p.u.z, p.u.w));
    put(o, kept.x, 1.0f);
    put(o, kept.y, 1.0f);
    put(o, pushed.x, 1.0f);
    put(o, pushed.y, 1.0f);
}

FN void probe_tonemap(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    put_relative(o, tonemap_input(p.special));
    put(o, tonemap_exponential(abs(p.number)), 1.0f);
    put(o, hable_curve(tonemap_input(p.number)), 1.0f);
    put(o, tonemap_uncharted2(tonemap_input(p.number)), 1.0f);
    put_relative(o, tonemap_aces(tonemap_input(p.number)));
    put3(o, tonemap_pbr_neutral(8.0f * p.u.w * p.color), 1.0f);
    put3(o, tonemap(p.words.x % 4u, p.radiance), 1.0f);
    put3(o, tonemap(TONEMAP_PBR_NEUTRAL, 4.0f * p.color_2), 1.0f);
}

FN void probe_srgb(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    put3(o, srgb_encode(p.color), 1.0f);
    put_relative(o, srgb_encode_component(p.u.x));
    put_relative(o, srgb_decode(p.u.y));
    put(o, srgb_encode_component(p.special), 1.0f);
}

SHARED_END

// See probe_list.h.
#define SAMPLING_PROBES(X)                                                                                             \
    X(disk, 8, 0, "one division, times pi/4, then sin_cos")                                                            \
    X(hemispheres, 8, 0, "sqrt or a division, then sin_cos")                                                           \
    X(frame, 16, 0, "one division, twice used; then sums of three products")                                           \
    X(triangle_by_area, 4, 0, "precise cross product; the two edges may be chosen otherwise at a tie")                 \
    X(triangle_view, 32, 100, "three inverse lengths, in products of two")                                             \
    X(triangle_pdf, 48, 100, "the view's, r^3 and two divisions")                                                      \
    X(triangle_by_angle, 256, 100, "the view's, then some twenty operations with five divisions")                      \
    X(mis, 8, 0, "two divisions")                                                                                      \
    X(camera, 16, 0, "sums of two products, a division, normalize")                                                    \
    X(environment, 12, 0, "rotation, arctan2 after sqrt")                                                              \
    X(ray_offset, 0, 0, "integers, and precise near zero")                                                             \
    X(tonemap, 16, 0, "quotients of quadratics")                                                                       \
    X(srgb, 16, 0, "a division, raised to 2.4")

#endif
