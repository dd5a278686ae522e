// Probes of reservoirs, reuse surfaces and the camera's projection.
#ifndef PROBES_RESAMPLING_H
#define PROBES_RESAMPLING_H

#include "probes_surface.h"

SHARED_BEGIN

FN void probe_reservoir(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    Reservoir empty = empty_reservoir();
    put_bits(o, empty.point.light);
    Resampling s = begin_resampling();
    LightPoint y = no_light_point();
    y.light = p.words.x;
    y.uv = vec2(p.u.x, p.u.y);
    add_candidate(s, y, abs(p.number), p.special, p.u.z);
    y.light = p.words.y;
    add_favored_candidate(s, y, p.u.w, p.u.x, FAVOR_HIDDEN, p.u.y);
    put_bits(o, floatBitsToUint(s.favor));
    put_bits(o, s.point.light);
    put_bits(o, floatBitsToUint(s.target));
    put_relative(o, s.weight_sum);
    put(o, s.weight_lost, s.weight_sum);
    Reservoir other = empty;
    other.point.light = p.words.z;
    other.weight = p.u.w;
    other.favor = FAVOR_HIDDEN + p.u.x;
    add_reservoir(s, other, p.u.z, p.u.y, p.u.z);
    put_bits(o, floatBitsToUint(s.favor));
    Reservoir r = end_resampling(s, 0.5f, 3.0f);
    put_bits(o, r.point.light);
    put_relative(o, r.weight);
    put_bits(o, floatBitsToUint(r.favor));
}

FN void probe_integrators(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    uint integrator = p.words.x % 5u;
    put_bits(o, samples_material(integrator) ? 1u : 0u);
    put_bits(o, samples_lights(integrator) ? 1u : 0u);
    put_bits(o, weighs_by_mis(integrator) ? 1u : 0u);
    put_bits(o, resamples_lights(integrator) ? 1u : 0u);
    put_bits(o, reuses_reservoirs(integrator) ? 1u : 0u);
    put_bits(o, floatBitsToUint(no_light().pdf));
}

FN void probe_pairwise_shares(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    float c = 1.0f + p.u.x;
    float s = c + 20.0f * p.u.y;
    put_relative(o, pairwise_neighbor_share(c, p.u.z, 1.0f, p.u.w, s));
    put_relative(o, pairwise_canonical_share(c, p.u.z, 1.0f, p.u.w, s));
    put_relative(o, pairwise_neighbor_share(c, abs(p.number), 1.0f, abs(p.other), s));
    put(o, pairwise_neighbor_share(c, 0.0f, 1.0f, 0.0f, s), 1.0f);
}

FN void probe_unit_vector_packing(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    put_bits(o, pack_snorm16(2.0f * p.u.x - 1.0f));
    put_relative(o, unpack_snorm16(p.words.x & 0xffffu));
    put3(o, unpack_unit_vector(p.words.y), 1.0f);
    // A coordinate may round to the next step, whose size is 2^-15: half of it is 2^7 units.
    put3(o, unpack_unit_vector(pack_unit_vector(p.axis)), 256.0f);
}

FN void probe_color_packing(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    put3(o, unpack_color(p.words.x), 1.0f);
    vec3 kept = unpack_color(pack_color(p.color));
    put3(o, kept, 16384.0f * max(max_component(p.color), 1.0e-9f));  // one step of 2^-9 of the largest
    put_path(o, kept.x > 0.0f);
}

/// Fields from bits, so that both languages unpack the same.
FN ReuseSurface probe_reuse_surface(IN(ProbeInput) p) {
    ReuseSurface s = no_reuse_surface();
    s.position = p.vertex;
    s.geometric_normal = p.words.x;
    s.normal = p.words.x ^ (p.words.y & 0x00ff00ffu);
    s.wo = p.words.x ^ (p.words.z & 0x0fff0fffu);
    s.diffuse = p.words.y;
    s.f0 = p.words.z;
    s.rest = REUSE_SURFACE_VALID | (p.words.w & 0xffff0006u) | 0xff00u;
    return s;
}

FN void probe_target(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    TargetSurface s = unpack_reuse_surface(probe_reuse_surface(p), 0xffffffffu);
    put_relative(o, s.alpha);
    put_relative(o, s.f90);
    float facing = dot(p.light, s.geometric_normal);
    put_path(o, facing > -TARGET_COS_MIN);
    vec3 sum = s.wo + p.light;
    put_path(o, dot(sum, sum) > 1.0e-12f);
    vec3 value = target_reflectance(s, p.light);
    // The lobe's logarithm moves by 4 / alpha for each unit that the half vector does, and that by 2 / |o + i|.
    float scale = 1.0f + 8.0f / (s.alpha * max(length(sum), 1.0e-3f));
    if ((s.flags & REUSE_SURFACE_MAPPED) != 0u) {
        scale *= probe_specular_normal_scale(s.normal, s.geometric_normal, s.wo);
        put_path(o, dot(reflect_off(s.geometric_normal, p.light), s.specular_normal) > 0.0f);
    }
    if (put_comparable(o, scale)) {
        put3(o, value, max_component(value) * scale);
        vec3 specular = target_specular(s, p.light, TARGET_COS_MIN);
        put3(o, specular, max_component(specular) * scale);
        SeenLight light = unseen_light();
        light.direction = p.light;
        light.radiance = p.color;
        light.measure = p.u.x;
        float target = unoccluded_target(s, light);
        put(o, target, max_component(value) * scale);
        put_relative(o, target_of_reflectance(p.color_2, light));
    }
}

FN void probe_similar(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    ReuseSurface a = probe_reuse_surface(p);
    ReuseSurface b = a;
    b.position = p.vertex + 0.1f * p.edge_1;
    b.normal = p.words.x ^ (p.words.w & 0x0fff0fffu);
    put_path(o, is_similar(a, b, p.vertex + p.axis));
    put_bits(o, is_similar(no_reuse_surface(), b, p.axis) ? 1u : 0u);
    put_bits(o, is_valid(a) ? 1u : 0u);
}

FN void probe_pack_surface(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    ReuseSurface s = pack_reuse_surface(p.vertex, probe_surface(p), p.view);
    put_same3(o, s.position);
    put_bits(o, s.rest & 0xffu);
    TargetSurface t = unpack_reuse_surface(s, 0xffffffffu);
    put3(o, t.geometric_normal, 256.0f);
    put3(o, t.wo, 256.0f);
    put(o, t.alpha, 256.0f);
    put_path(o, wants_reuse(probe_surface(p), p.view));
    put_path(o, dot(p.mapped, p.view) >= BENT_COS);
    put_path(o, dot(p.mapped, p.axis) >= MAPPED_COS);
    put3(o, reuse_normal(probe_surface(p), p.view), probe_bend_scale(p.mapped, p.view) + probe_bend_scale(p.mapped, p.axis));
}

FN void probe_projection(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    Camera camera;
    camera.origin = p.vertex;
    camera.kind = p.words.x % 4u == 0u ? CAMERA_ORTHOGRAPHIC : CAMERA_PERSPECTIVE;
    camera.right = 0.7f * p.axis_2;
    camera.lens_radius = 0.0f;
    camera.up = p.wi;
    camera.focus_distance = 1.0f;
    camera.forward = p.axis;
    vec2 film;
    bool ahead = camera_project(camera, p.vertex + p.light, film);
    put_path(o, ahead);
    float along = max(dot(p.light, p.axis), 1.0e-6f);
    float scale = (4.0f + length(p.vertex)) * (1.0f + 1.0f / along) / along;
    if (put_comparable(o, scale)) {
        put(o, film.x, scale);
        put(o, film.y, scale);
    }
}

FN void probe_independent_words(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    Sampler random = make_sampler(uvec2(p.words.x, p.words.y), p.words.z, p.words.w, SAMPLER_INDEPENDENT, 1u);
    put_bits4(o, independent_words(random, p.set.x));
}

FN void probe_light_cluster(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    LightCluster cluster;
    cluster.center = p.vertex;
    cluster.spread = 1.0e-6f + p.u.x * p.u.x;
    cluster.radius = 1.0e-3f + p.u.x;
    cluster.pmf = p.u.y;
    cluster.first = 0u;
    cluster.count = 1u;
    put_bits(o, part_of_flags(p.words.x));
    vec3 d = p.vertex - p.edge_1;
    put(o, squared_excess(cluster, p.edge_1), dot(d, d) + 4.0f * cluster.radius * cluster.radius);
    // cos/r², whose numerator may cancel.
    float squared = dot(d, d) + cluster.spread;
    put(o, cluster_falloff(cluster, p.edge_1, p.axis), (length(d) + cluster.radius) * inversesqrt(squared) / squared);
}

FN void probe_light_tree(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    LightNode node;
    LightWeights whole;
    for (uint i = 0u; i < LIGHT_NODE_WIDTH; i++) {
        node.center_x[i] = p.vertex.x;
        node.center_y[i] = p.vertex.y;
        node.center_z[i] = p.vertex.z;
        node.place[i] = 1.0f;
        node.spread[i] = 0.01f + p.u.x;
        node.axis_x[i] = 0.5f * p.axis.x;
        node.axis_y[i] = 0.5f * p.axis.y;
        node.axis_z[i] = 0.5f * p.axis.z;
        node.blur[i] = 0.1875f;
        node.front[i] = p.u.y;
        node.power[i] = 1.0f;
        node.child[i] = 100u + i;
        whole.of[i] = float((p.words.x >> (3u * i)) & 7u);  // sums of integers are exact
    }
    vec3 d = p.vertex - p.edge_1;
    float most = 9.0f / (dot(d, d) + node.spread[0]);
    put(o, light_weight(node, 0u, p.edge_1, p.axis), most);
    put(o, light_weights(node, p.edge_1, p.axis).total, 8.0f * most);
    whole.of[7] = 1.0f;
    sum_weights(whole);
    put_bits(o, uint(whole.total));
    SharedNumber n = share_number(uvec2(p.words.y, p.words.z));
    PickedChild picked = pick_child(node, whole, n);
    put_bits(o, picked.link);
    put_relative(o, picked.probability);
    put_relative(o, child_probability(whole, p.words.w & 7u));
    n = share_number(uvec2(p.words.y, p.words.z));
    stretch(n, 0.5f * p.u.z, 1.0f, 1.0f);
    put(o, n.u, 1.0f);
    n = share_number(uvec2(p.words.y, p.words.z));
    put_bits(o, pick_leaf_column(leaf_size(p.words.w), n));
    put3(o, unpack_facing(p.words.x), 1.0f);
    put(o, facing_component(p.words.x, 10u), 1.0f);
    put_bits(o, pack_facing(vec3(1.0f, -1.0f, 0.0f)));
    put_bits(o, no_light_pick().id);
}

#define RESAMPLING_PROBES(X)                                                                                           \
    X(integrators, 0, 0, "comparisons of integers")                                                                    \
    X(reservoir, 8, 50, "sums, a division, products")                                                                  \
    X(pairwise_shares, 24, 0, "three divisions")                                                                       \
    X(unit_vector_packing, 8, 100, "a normalize; a coordinate may round to the next step")                             \
    X(color_packing, 8, 100, "a product; a channel may round to the next step")                                        \
    X(target, 32, 500, "dot products and normalize, a square root each for masking, four divisions")                   \
    X(similar, 8, 500, "nothing but its answer")                                                                       \
    X(pack_surface, 8, 100, "a coordinate may round to the next step")                                                 \
    X(projection, 16, 50, "dot products and three divisions")                                                          \
    X(independent_words, 0, 0, "integers")                                                                             \
    X(light_cluster, 32, 50, "dot products, an inversesqrt and its cube")                                              \
    X(light_tree, 64, 50, "dot products, three square roots, a division, and a sum that cancels")

SHARED_END

#endif
