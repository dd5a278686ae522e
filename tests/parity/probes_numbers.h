// Probes of integers, random numbers, elementary functions and sums.
#ifndef PROBES_NUMBERS_H
#define PROBES_NUMBERS_H

#include "probe.h"

SHARED_BEGIN

FN void probe_words(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    put_bits4(o, pcg4d(p.words));
    put_bits(o, hash_word(p.words.x));
    put_bits(o, hash_combine(p.words.x, p.words.y));
    put_bits(o, floatBitsToUint(unit_float(p.words.z)));
    put_bits(o, multiply_high(p.words.x, p.words.y));
    put_bits(o, alias_column(p.words.z, p.set.y));
    AliasEntry entry;
    entry.probability = p.u.x;
    entry.alias = p.words.w;
    put_bits(o, alias_pick(entry, p.set.x, p.words.x));
    entry.probability = p.number;
    put_bits(o, alias_pick(entry, p.set.x, p.words.y));
}

FN Sampler probe_sampler_of(IN(ProbeInput) p) {
    return make_sampler(uvec2(p.words.x & 0xffffu, p.words.x >> 16), p.set.x, p.words.y, p.words.z % 3u, p.set.y);
}

FN uint probe_dimension(IN(ProbeInput) p) {
    return 2u * (p.words.w % 60u);
}

FN void probe_sampler_parts(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    Sampler s = probe_sampler_of(p);
    uint dimension = probe_dimension(p);
    put_bits2(o, s.key);
    put_bits(o, s.reversed_index);
    put_bits2(o, independent_bits_2d(s, dimension));
    uvec3 words = dimension_words(s, dimension);
    put_bits(o, words.x);
    put_bits(o, words.y);
    put_bits(o, words.z);
    put_bits(o, stratum_center_bits(p.set.x, p.set.y));
    put_bits(o, permute_index(p.set.x, p.set.y, p.words.z));
    put_bits2(o, hammersley_bits_2d(s, dimension & 2u));
    put_bits(o, owen_scramble_reversed(p.words.x, p.words.y));
    put_bits(o, sobol_second_reversed(p.words.x));
    put_bits2(o, sobol_bits_2d(s, dimension));
}

FN void probe_sampler(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    Sampler s = probe_sampler_of(p);
    uint dimension = probe_dimension(p);
    put_bits2(o, sample_bits_2d(s, dimension));
    FourPairs pairs = sample_bits_four_pairs(s, dimension);
    put_bits4(o, pairs.first);
    put_bits4(o, pairs.second);
    vec2 u = sample_2d(s, dimension);
    put_bits(o, floatBitsToUint(u.x));
    put_bits(o, floatBitsToUint(u.y));
    put_bits(o, floatBitsToUint(sample_1d(s, dimension)));
}

FN void probe_bit_tests(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    float a = uintBitsToFloat(p.words.x);
    put_bits(o, is_nan(a) ? 1u : 0u);
    put_bits(o, is_bad_component(a) ? 1u : 0u);
    put_bits(o, is_bad_sample(p.radiance) ? 1u : 0u);
    put_bits(o, floatBitsToUint(positive_infinity()));
}

FN void probe_small_helpers(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    put_relative(o, safe_sqrt(p.number));
    put_relative(o, luminance(p.color));
    put_bits(o, floatBitsToUint(max_component(p.edge_1)));
    put_bits(o, floatBitsToUint(largest_magnitude(p.edge_1)));
    put_same3(o, xyz(vec4(p.axis.x, p.axis.y, p.axis.z, 1.0f)));
}

FN void probe_sin_cos(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    float s;
    float c;
    sin_cos_octant(QUARTER_PI * p.u.x, s, c);
    put(o, s, 1.0f);
    put(o, c, 1.0f);
    sin_cos(p.angle, s, c);
    put_relative(o, s);
    put_relative(o, c);
    sin_cos(p.special, s, c);
    put_relative(o, s);
    put_relative(o, c);
}

FN void probe_arctan2(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    put_relative(o, arctan2(p.number, p.other));
    put_relative(o, arctan2(p.edge_1.x, p.edge_1.y));
    put_relative(o, arctan2(p.axis.x, p.axis.y));
}

FN void probe_arccos(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    put_relative(o, arccos(p.axis.x));
    put_relative(o, arccos(p.number));
}

FN void probe_exp2(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    put_relative(o, exp2_poly(uintBitsToFloat(p.words.x)));
    put_relative(o, exp2_poly(256.0f * p.u.x - 127.0f));
    put_relative(o, exp2_poly(p.special));
}

FN void probe_logarithms(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    put_relative(o, log2_poly(uintBitsToFloat(p.words.x)));
    put_relative(o, log2_poly(p.special));
    put_relative(o, log2_poly(0.5f + 1.5f * p.u.x));
    put_relative(o, log1p_poly(p.special));
    put_relative(o, log1p_poly(p.angle));
    put_relative(o, log1p_poly(-p.u.y));
    put_relative(o, log1p_reduced(0.7f * p.u.z - 0.29f));
    float f;
    put_relative(o, split_exponent(abs(p.number), f));
    put_relative(o, f);
}

FN void probe_power(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    put_relative(o, pow_poly(abs(p.number), 4.0f * p.u.x - 2.0f));
    put_relative(o, pow_poly(p.u.y, 40.0f * p.u.z));
}

FN ExactSum empty_exact_sum() {
    ExactSum s;
    for (int k = 0; k < 3; ++k) {
        s.low[k] = uvec3(0u, 0u, 0u);
        s.high[k] = uvec3(0u, 0u, 0u);
    }
    s.base = 0u;
    return s;
}

FN void put_bits3(INOUT(ProbeOutput) o, uvec3 bits) {
    put_bits(o, bits.x);
    put_bits(o, bits.y);
    put_bits(o, bits.z);
}

FN void put_exact_sum(INOUT(ProbeOutput) o, IN(ExactSum) s) {
    for (int k = 0; k < 3; ++k) {
        put_bits3(o, s.low[k]);
        put_bits3(o, s.high[k]);
    }
    put_bits(o, s.base);
}

FN void probe_exact_digits(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    int digit = int(p.words.w % 6u);
    put_bits(o, float_mantissa(p.number));
    put_bits(o, uint(float_position(p.number)));
    put_bits(o, digit_of(p.words.x, int(p.words.y % 200u), digit));
    put_bits(o, square_digit(p.number, digit));
    put_bits(o, carry_of(p.words.x + p.words.y, p.words.y));
    put_bits(o, uint(fixed_point(p.axis.x)));
    uvec3 low = uvec3(p.words.x, p.words.y, p.words.z);
    uvec3 high = uvec3(0u, 0u, 0u);
    add_words(low, high, uvec3(p.words.y, p.words.z, p.words.w));
    put_bits3(o, low);
    put_bits3(o, high);
}

FN void probe_exact_sums(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    ExactSum s = empty_exact_sum();
    vec3 x = abs(p.vertex);
    bool finite = !is_bad_sample(x) && !is_bad_sample(p.radiance);
    exact_add(s, finite ? x : vec3(0.0f, 0.0f, 0.0f));
    exact_add_square(s, finite ? p.radiance : vec3(0.0f, 0.0f, 0.0f));
    raise_base(s, 3 + int(p.words.x & 3u));
    put_exact_sum(o, s);
}

FN void probe_fixed_sums(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    FixedSum s;
    s.low = uvec3(p.words.x, p.words.y, p.words.z);
    s.high = uvec3(0u, 0u, 0u);
    fixed_add(s, p.axis);
    put_bits3(o, s.low);
    put_bits3(o, s.high);
}

FN void probe_film_counts(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    FilmPixel pixel;
    pixel.sum = empty_exact_sum();
    pixel.samples = p.set.x;
    pixel.nonfinite = p.words.y;
    pixel.rays = p.words.x;
    pixel.ray_wraps = p.words.z;
    bool kept = film_add(pixel, p.radiance, 7u);
    put_bits(o, 2u * (pixel.ray_wraps - p.words.z) + (kept ? 1u : 0u));
    put_bits(o, pixel.samples);
    put_bits(o, pixel.nonfinite);
    put_bits(o, pixel.rays);
}

FN void probe_film_sums(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    FilmPixel pixel;
    pixel.sum = empty_exact_sum();
    pixel.sum.base = p.set.x & 1u;
    pixel.sum.low[0] = uvec3(p.words.x, p.words.y, p.words.z);
    pixel.sum.low[1] = uvec3(p.words.w, p.words.x, p.words.y);
    pixel.samples = 0u;
    pixel.nonfinite = 0u;
    pixel.rays = 0u;
    pixel.ray_wraps = 0u;
    film_add(pixel, p.radiance, 7u);
    film_add(pixel, abs(p.edge_1), 7u);
    put_exact_sum(o, pixel.sum);
}

FN void probe_film_moments(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    FilmMoments moments;
    moments.squares = empty_exact_sum();
    film_add_moments(moments, abs(p.vertex));
    film_add_moments(moments, p.color_2);
    put_exact_sum(o, moments.squares);
}

FN void probe_film_first_hit(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    FilmFirstHit film;
    film.albedo.low = uvec3(p.words.x, p.words.y, p.words.z);
    film.albedo.high = uvec3(0u, 0u, 0u);
    film.normal.low = uvec3(0u, 0u, 0u);
    film.normal.high = uvec3(0u, 0u, 0u);
    film.depth.low = uvec2(p.words.x, p.words.y);
    film.depth.high = uvec2(0u, 0u);
    film.depth.base = 0u;
    FirstHit hit;
    hit.albedo = p.color_2;
    hit.normal = p.axis_2;
    hit.depth = p.u.y;
    film_add_first_hit(film, hit);
    put_bits3(o, film.albedo.low);
    put_bits3(o, film.albedo.high);
    put_bits3(o, film.normal.low);
    put_bits3(o, film.normal.high);
    put_bits(o, film.depth.low.x);
    put_bits(o, film.depth.low.y);
    put_bits(o, film.depth.high.x);
    put_bits(o, film.depth.high.y);
    put_bits(o, film.depth.base);
}

FN void probe_path_record(IN(ProbeInput) p, INOUT(ProbeOutput) o) {
    Hit hit;
    hit.instance = (p.words.x & 7u) == 0u ? NONE : p.words.x;
    hit.geometry = p.words.y;
    hit.primitive = p.words.z;
    hit.barycentrics = vec2(p.u.x, p.u.y);
    hit.t = p.number;
    PathVertexRecord vertex = begin_vertex_record(p.axis, hit);
    put_bits(o, vertex.geometry);
    put_bits(o, floatBitsToUint(vertex.t));
    put_same3(o, vertex.direction);
    vertex.light = p.words.w;
    vertex.lobe = p.words.y & 15u;
    vertex.shadow = p.words.z % 3u;
    put_bits(o, vertex_decisions(vertex));
    PathSummary summary = begin_path_summary();
    for (uint i = 0u; i < p.words.w % 20u; i++) {
        summarize_vertex(summary, vertex);
        vertex.roulette = i % 3u;
    }
    put_bits(o, summary.vertices);
    put_bits(o, summary.signature[0]);
    put_bits(o, summary.signature[5]);
    put_bits(o, summary.signature[SIGNATURE_VERTICES - 1u]);
}

SHARED_END

// See probe_list.h.
#define NUMBER_PROBES(X)                                                                                               \
    X(words, 0, 0, "integers")                                                                                         \
    X(sampler_parts, 0, 0, "integers")                                                                                 \
    X(sampler, 0, 0, "integers; a 24-bit integer times 2^-24 is exact")                                                \
    X(bit_tests, 0, 0, "by the bits")                                                                                  \
    X(small_helpers, 6, 0, "sqrt")                                                                                     \
    X(sin_cos, 4, 0, "precise; the quadrant's product may be fused, and at a tie both are within 1.6")                 \
    X(arctan2, 8, 0, "one division; then precise")                                                                     \
    X(arccos, 16, 0, "sqrt, then a division")                                                                          \
    X(exp2, 1, 0, "precise")                                                                                           \
    X(logarithms, 1, 0, "precise")                                                                                     \
    X(power, 1, 0, "precise log2 and exp2 about one product")                                                          \
    X(exact_digits, 0, 0, "integers")                                                                                  \
    X(exact_sums, 0, 0, "integers")                                                                                    \
    X(fixed_sums, 0, 0, "integers, but for the floor of a product with a power of two")                                \
    X(film_counts, 0, 0, "integers")                                                                                   \
    X(film_sums, 0, 0, "integers")                                                                                     \
    X(film_moments, 0, 0, "integers")                                                                                  \
    X(film_first_hit, 0, 0, "integers, but for the floor of a product with a power of two")                            \
    X(path_record, 0, 0, "integers and copies")

#endif
