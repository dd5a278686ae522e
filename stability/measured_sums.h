// Measured: sums, picks and the ends of random numbers.
#ifndef MEASURED_SUMS_H
#define MEASURED_SUMS_H

#include "measured_values.h"

SHARED_BEGIN

/// The n-th sample that the film is fed: constant, random, and dim but for a rare firefly.
FN vec3 measured_sample(float value, uint n) {
    float random = unit_float(hash_word(n));
    return vec3(value, random, (n & 4095u) == 0u ? 1.0e6f * value : value * random);
}

/// A pixel fed with one component of measured_sample: x 0 value; n 0 first sample, 1 how many, 2 component -> n 0-5 the
/// words of its sum's bins, lowest first, 6 their base, 7 samples averaged; y 0 dropped.
FN void measure_film(IN(MeasuredInput) p, INOUT(MeasuredOutput) o) {
    FilmPixel pixel;
    for (int k = 0; k < 3; ++k) {
        pixel.sum.low[k] = uvec3(0u, 0u, 0u);
        pixel.sum.high[k] = uvec3(0u, 0u, 0u);
    }
    pixel.sum.base = 0u;
    pixel.samples = 0u;
    pixel.nonfinite = 0u;
    pixel.rays = 0u;
    pixel.ray_wraps = 0u;
    for (uint i = 0u; i < p.n[1]; ++i) {
        vec3 drawn = measured_sample(p.x[0], p.n[0] + i);
        film_add(pixel, vec3(p.n[2] == 0u ? drawn.x : p.n[2] == 1u ? drawn.y : drawn.z, 0.0f, 0.0f), 1u);
    }
    for (int k = 0; k < 3; ++k) {
        o.n[2 * k] = pixel.sum.low[k].x;
        o.n[2 * k + 1] = pixel.sum.high[k].x;
    }
    o.n[6] = pixel.sum.base;
    o.n[7] = pixel.samples;
    o.y[0] = float(pixel.nonfinite);
}

/// A reservoir on its way: x 0-7 weights that come by in turn, 8 and 9 the sum so far; n 0 how many come, 1 seed -> y 0
/// W for a target of 1 over n 0, 1 and 2 the sum; n 0 which came last to be kept, modulo 8; NONE: nothing.
FN void measure_reservoir(IN(MeasuredInput) p, INOUT(MeasuredOutput) o) {
    Resampling s = begin_resampling();
    s.weight_sum = p.x[8];
    s.weight_lost = p.x[9];
    for (uint i = 0u; i < p.n[0]; ++i) {
        LightPoint y = no_light_point();
        y.light = i & 7u;
        add_candidate(s, y, 1.0f, p.x[i & 7u], unit_float(hash_combine(p.n[1], i)));
    }
    Reservoir r = end_resampling(s, 1.0f / float(max(p.n[0], 1u)), 1.0f);
    o.y[0] = r.weight;
    o.y[1] = s.weight_sum;
    o.y[2] = s.weight_lost;
    o.n[0] = r.point.light;
}

/// An alias table of eight: x 0-7 probabilities to keep, n 0 aliases of four bits each, n 1 entries, n 2-3 random words
/// -> n 0 the pick.
FN void measure_alias(IN(MeasuredInput) p, INOUT(MeasuredOutput) o) {
    uint column = alias_column(p.n[2], p.n[1]);
    AliasEntry e;
    e.probability = p.x[column];
    e.alias = (p.n[0] >> (4u * column)) & 15u;
    o.n[0] = alias_pick(e, column, p.n[3]);
}

/// x 0-1 densities; n 0 heuristic -> y 0.
FN void measure_mis(IN(MeasuredInput) p, INOUT(MeasuredOutput) o) {
    o.y[0] = mis_weight(p.n[0], p.x[0], p.x[1]);
}

/// n 0 any word -> y 0 in [0, 1).
FN void measure_unit_float(IN(MeasuredInput) p, INOUT(MeasuredOutput) o) {
    o.y[0] = unit_float(p.n[0]);
}

FN bool measured_unit(vec3 v) {
    float squared = dot(v, v);
    return squared > 0.9999f && squared < 1.0001f;
}

FN uint measured_fault(uint bit, bool fine) {
    return fine ? 0u : 1u << bit;
}

/// Every sampler at the ends of its random numbers: n 0, 1, 2 words, x 0 alpha, 1-3 wo -> n 0 a bit for each sampler
/// that gave what it may not; y 0-2 the numbers.
FN void measure_ends_of_u(IN(MeasuredInput) p, INOUT(MeasuredOutput) o) {
    vec2 u = vec2(unit_float(p.n[0]), unit_float(p.n[1]));
    float u_lobe = unit_float(p.n[2]);
    vec3 wo = measured_vec3(p, 1u);
    vec2 disk = sample_disk_concentric(u);
    uint faults = measured_fault(0u, dot(disk, disk) <= 1.000001f);
    vec3 w = sample_cosine_hemisphere(u);
    faults |= measured_fault(1u, measured_unit(w) && w.z >= 0.0f);
    w = sample_uniform_hemisphere(u);
    faults |= measured_fault(2u, measured_unit(w) && w.z >= 0.0f);
    w = sample_uniform_sphere(u);
    faults |= measured_fault(3u, measured_unit(w));
    vec2 b = sample_triangle(u);
    faults |= measured_fault(4u, b.x >= 0.0f && b.y >= 0.0f && b.x + b.y <= 1.0f);
    TriangleSample t = sample_triangle_solid_angle(vec3(0.0f, 0.0f, 0.0f), vec3(-0.5f, -0.4f, 1.0f),
                                                   vec3(1.1f, 0.1f, 0.2f), vec3(0.2f, 0.9f, -0.3f), u);
    b = t.barycentrics;
    faults |= measured_fault(5u, t.pdf > 0.0f && b.x >= 0.0f && b.y >= 0.0f && b.x + b.y <= 1.000001f);
    w = sample_ggx_visible_normal(wo, p.x[0], u);
    faults |= measured_fault(6u, measured_unit(w) && w.z >= 0.0f);
    w = sample_blinn_phong_normal(p.x[0], u);
    faults |= measured_fault(7u, measured_unit(w) && w.z >= 0.0f);
    for (uint model = 0u; model < 2u; ++model) {
        BsdfParameters m =
            bsdf_parameters(vec3(0.8f, 0.8f, 0.8f), 0.0f, sqrt(p.x[0]), 0.04f, 1.0f, vec3(1.0f, 1.0f, 1.0f), model);
        BsdfSample s = bsdf_sample_local(m, wo, u_lobe, u, 0xffffffffu);
        faults |= measured_fault(8u + model, s.pdf >= 0.0f && s.pdf < INFINITE_DISTANCE && s.weight.x >= 0.0f &&
                                                 s.weight.x < INFINITE_DISTANCE && measured_unit(s.direction));
    }
    AliasEntry e;
    e.probability = u.x;
    e.alias = 2u;
    uint column = alias_column(p.n[0], 3u);
    faults |= measured_fault(10u, column < 3u && alias_pick(e, column, p.n[1]) < 3u);
    // A light whose column is never kept must never come by the last word.
    e.probability = 0.0f;
    faults |= measured_fault(11u, alias_pick(e, 0u, p.n[1]) == 2u);
    faults |= measured_fault(12u, u.x < 1.0f && u.y < 1.0f && u_lobe < 1.0f);
    // What comes first must be able to stay, what weighs nothing must not.
    Resampling s = begin_resampling();
    LightPoint y = no_light_point();
    y.light = 7u;
    add_candidate(s, y, 1.0f, 1.0f, u.x);
    faults |= measured_fault(13u, s.point.light == 7u);
    y.light = 8u;
    add_candidate(s, y, 1.0f, 0.0f, u.x);
    faults |= measured_fault(14u, s.point.light == 7u);
    o.n[0] = faults;
    give_vec3(o, 0u, vec3(u.x, u.y, u_lobe));
}

SHARED_END

#define MEASURED_SUMS(X)                                                                                               \
    X(film)                                                                                                            \
    X(reservoir)                                                                                                       \
    X(alias)                                                                                                           \
    X(mis)                                                                                                             \
    X(unit_float)                                                                                                      \
    X(ends_of_u)

#endif
