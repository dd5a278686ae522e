// Probes of warps, frames, triangles, weights, cameras, environment maps, ray offsets and tone maps.
#ifndef PROBES_SAMPLING_H
#define PROBES_SAMPLING_H

#include "probe.h"

SHARED_BEGIN

FN void probe_disk(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    vec2 u = vec2(p.u.x, p.u.y);
    float radius;
    float angle;
    concentric_polar(u, radius, angle);
    put_bits(o, floatBitsToUint(radius));
    put_relative(o, angle);
    vec2 disk = sample_disk_concentric(u);
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

/// How much the view's volume and its angle move where coordinates do by an ulp of the distance.
FN float probe_volume_scale(IN(TriangleView) view) {
    vec3 e3 = view.e2 - view.e1;
    float l1 = length(view.e1);
    float l2 = length(view.e2);
    float l3 = length(e3);
    float edges = l1 * l2 * l3 / max(max(l1, max(l2, l3)), 1.0e-30f);
    return edges * view.lengths.x;
}

FN float probe_angle_scale(IN(TriangleView) view) {
    float volume = abs(view.volume);
    float volume_scale = probe_volume_scale(view);
    float denominator_scale = view.lengths.x * view.lengths.y * view.lengths.z;
    float square = volume * volume + view.denominator * view.denominator;
    float slope = abs(view.denominator) * volume_scale + volume * denominator_scale;
    return view_solid_angle(view) + slope / max(square, 1.0e-35f);
}

FN void probe_triangle_view(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    vec3 reference = vec3(0.0f, 0.0f, 0.0f);
    TriangleView view = triangle_view(reference, p.vertex, p.edge_1, p.edge_2);
    put_bits(o, floatBitsToUint(view.scale));
    put_same3(o, view.a);
    put_same3(o, view.b);
    put_same3(o, view.c);
    put(o, view.volume, probe_volume_scale(view));
    float denominator_scale = view.lengths.x * view.lengths.y * view.lengths.z;
    put(o, view.denominator, denominator_scale);
    put(o, view.edge_ab, denominator_scale);
    put_relative(o, view.lengths.x);
    put_path(o, samples_spherically(view));
    put(o, view_solid_angle(view), probe_angle_scale(view));
    put(o, solid_angle_triangle(reference, p.vertex, p.edge_1, p.edge_2), probe_angle_scale(view));
}

FN void probe_triangle_pdf(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    vec3 reference = vec3(0.0f, 0.0f, 0.0f);
    TriangleView view = triangle_view(reference, p.vertex, p.edge_1, p.edge_2);
    bool spherical = samples_spherically(view);
    put_path(o, spherical);
    vec2 b = sample_triangle(vec2(p.u.x, p.u.y));
    vec3 point = p.vertex + b.x * p.edge_1 + b.y * p.edge_2;
    float cancelled = (length(view.a) + length(view.e1) + length(view.e2)) / max(length(point) * view.scale, 1.0e-20f);
    float by_area = cancelled + probe_volume_scale(view) / max(abs(view.volume), 1.0e-30f);
    float by_angle = probe_angle_scale(view) / max(view_solid_angle(view), 1.0e-30f);
    float pdf = pdf_triangle_solid_angle(reference, p.vertex, p.edge_1, p.edge_2, point);
    put(o, pdf, pdf * (spherical ? by_angle : by_area));
    float area_pdf = pdf_triangle_area_solid_angle(view, point * view.scale);
    put(o, area_pdf, area_pdf * by_area);
    TriangleSample s = sample_triangle_solid_angle(reference, p.vertex, p.edge_1, p.edge_2, vec2(p.u.x, p.u.y));
    vec3 sampled = p.vertex + s.barycentrics.x * p.edge_1 + s.barycentrics.y * p.edge_2;
    float lost = (length(view.a) + length(view.e1) + length(view.e2)) / max(length(sampled) * view.scale, 1.0e-20f);
    put(o, s.pdf, s.pdf * (spherical ? by_angle : by_area + lost));
}

/// By solid angle: the direction, as barycentrics of far triangles move more than what they stand for.
FN void probe_triangle_by_angle(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    vec3 reference = vec3(0.0f, 0.0f, 0.0f);
    TriangleView view = triangle_view(reference, p.vertex, p.edge_1, p.edge_2);
    bool spherical = samples_spherically(view);
    put_path(o, spherical);
    if (!spherical) {
        return;
    }
    float angle = view_solid_angle(view);
    vec2 u = vec2(p.u.x, p.u.y);
    vec2 b = sample_spherical_triangle(view, angle, u);
    TriangleSample s = sample_triangle_solid_angle(reference, p.vertex, p.edge_1, p.edge_2, u);
    float scale = 1.0f + probe_angle_scale(view) / angle;
    put3(o, normalize(view.a + b.x * view.e1 + b.y * view.e2), scale);
    put3(o, normalize(view.a + s.barycentrics.x * view.e1 + s.barycentrics.y * view.e2), scale);
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
    put_same3(o, offset_ray(p.vertex, p.axis));
    put_same3(o, offset_ray(p.edge_1, p.axis_2));
    put_bits(o, floatBitsToUint(offset_coordinate(p.number, p.axis.x)));
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
    X(triangle_view, 32, 100, "three lengths by sqrt, in products of three")                                           \
    X(triangle_pdf, 48, 100, "the view's, r^3 and two divisions")                                                      \
    X(triangle_by_angle, 256, 100, "the view's, then some twenty operations with five divisions")                      \
    X(mis, 8, 0, "two divisions")                                                                                      \
    X(camera, 16, 0, "sums of two products, a division, normalize")                                                    \
    X(environment, 12, 0, "rotation, arctan2 after sqrt")                                                              \
    X(ray_offset, 0, 0, "integers, and precise near zero")                                                             \
    X(tonemap, 16, 0, "quotients of quadratics")                                                                       \
    X(srgb, 16, 0, "a division, raised to 2.4")

#endif
