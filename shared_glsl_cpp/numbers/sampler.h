// Random numbers as a pure function of (pixel, sample, dimension, seed), so that any sample can be replayed alone.
// Every word is uniform over seeds, so that every kind of sampler gives an unbiased estimate.
#ifndef SAMPLER_H
#define SAMPLER_H

#include "numbers/dimensions.h"
#include "numbers/rng.h"

SHARED_BEGIN

CONST uint SAMPLER_INDEPENDENT = 0u;
CONST uint SAMPLER_HAMMERSLEY = 1u;  // for film and lens only; other dimensions are independent
CONST uint SAMPLER_SOBOL = 2u;       // for dimensions below SOBOL_MAX_DIMENSION; others are independent

CONST uint SOBOL_MAX_DIMENSION = 100u;  // camera and eight vertices
CONST uint HAMMERSLEY_MAX_COUNT = 1u << 23;

/// One sample of one pixel; make_sampler fills it.
struct Sampler {
    uvec2 key;  // hash of pixel and seed
    uint sample_index;
    uint reversed_index;
    uint kind;          // SAMPLER_…
    uint sample_count;  // of the Hammersley set
};

FN Sampler make_sampler(uvec2 pixel, uint sample_index, uint seed, uint kind, uint sample_count) {
    Sampler s;
    uvec4 words = pcg4d(uvec4(pixel.x, pixel.y, hash_word(seed + 0x9e3779b9u), 0x50697865u));
    s.key = uvec2(words.x, words.y);
    s.sample_index = sample_index;
    s.reversed_index = bitfieldReverse(sample_index);
    s.kind = kind;
    s.sample_count = sample_count;
    return s;
}

/// Four independent words of one dimension. These dimensions are not drawn in pairs.
FN uvec4 independent_words(IN(Sampler) s, uint dimension) {
    uint index = MUTANT(RESAMPLING_SEED_FROZEN, s.sample_index, 0u);
    return pcg4d(uvec4(s.key.x, s.key.y, index, dimension));
}

FN uvec2 independent_bits_2d(IN(Sampler) s, uint dimension) {
    uvec4 v = pcg4d(uvec4(s.key.x, s.key.y, s.sample_index, dimension));
    return uvec2(v.z, v.w);
}

/// Three words that are the same for all samples of a pixel, for a pair of dimensions.
FN uvec3 dimension_words(IN(Sampler) s, uint dimension) {
    uint a = hash_word(s.key.x ^ (dimension * 0x9e3779b9u));
    uint b = hash_word(s.key.y + dimension * 0x85ebca6bu);
    return uvec3(a, b, hash_word(a + s.key.y));
}

/// (i + 1/2)/n as a 32-bit fraction, rounded down, by long division; i < n <= HAMMERSLEY_MAX_COUNT.
FN uint stratum_center_bits(uint i, uint n) {
    uint divisor = 2u * n;
    uint remainder = 2u * i + 1u;
    uint bits = 0u;
    for (uint digit = 0u; digit < 4u; digit++) {
        uint shifted = remainder << 8;
        uint quotient = shifted / divisor;
        bits = (bits << 8) | quotient;
        remainder = shifted - quotient * divisor;
    }
    return bits;
}

/// A permutation of 0 .. n-1 that depends on `key`: invertible steps on the next power of two, repeated until the
/// result is below n (Kensler 2013, "Correlated Multi-Jittered Sampling").
FN uint permute_index(uint i, uint n, uint key) {
    uint mask = n - 1u;
    mask |= mask >> 1;
    mask |= mask >> 2;
    mask |= mask >> 4;
    mask |= mask >> 8;
    mask |= mask >> 16;
    uint x = i;
    do {
        x = (x * (key | 1u) + (key >> 16)) & mask;
        x = x ^ (x >> 3);
        x = (x * 0x7feb352du + (key >> 5)) & mask;
        x = x ^ (x >> 7);
        x = (x * ((key >> 11) | 1u) + key) & mask;
        x = x ^ (x >> 2);
        x = (x * 0x846ca68bu) & mask;
        x = x ^ (x >> 5);
    } while (x >= n);
    return x;
}

/// Point i of the Hammersley set (i/n, radical inverse of i), shifted on the torus per pixel (Cranley and Patterson
/// 1976). The lens uses the same set in another order.
FN uvec2 hammersley_bits_2d(IN(Sampler) s, uint dimension) {
    uvec3 words = dimension_words(s, dimension);
    uint i = s.sample_index;
    if (dimension != DIMENSION_FILM) {
        i = permute_index(i, s.sample_count, words.z);
    }
    return uvec2(words.x + stratum_center_bits(i, s.sample_count), words.y + bitfieldReverse(i));
}

/// Owen scrambling of a bit-reversed word: each bit is flipped by a hash of the bits below it (Laine & Karras 2011,
/// with the constants of Vegdahl 2021, "Building a Better LK Hash").
FN uint owen_scramble_reversed(uint x, uint key) {
    x = x ^ (x * 0x3d20adeau);
    x += key;
    x *= (key >> 16) | 1u;
    x = x ^ (x * 0x05526c56u);
    return x ^ (x * 0x53a22864u);
}

/// The second Sobol' dimension of index i, bit-reversed: Pascal's triangle mod 2 as five butterflies.
FN uint sobol_second_reversed(uint i) {
    i = i ^ (i >> 16);
    i = i ^ ((i >> 8) & 0x00ff00ffu);
    i = i ^ ((i >> 4) & 0x0f0f0f0fu);
    i = i ^ ((i >> 2) & 0x33333333u);
    return i ^ ((i >> 1) & 0x55555555u);
}

/// A (0,2)-sequence with Owen scrambling. Its order is shuffled per pixel and pair of dimensions (Burley 2020,
/// "Practical Hash-based Owen Scrambling").
FN uvec2 sobol_bits_2d(IN(Sampler) s, uint dimension) {
    uvec3 words = dimension_words(s, dimension);
    uint i = bitfieldReverse(owen_scramble_reversed(s.reversed_index, words.z));
    uint first = owen_scramble_reversed(i, words.x);
    uint second = owen_scramble_reversed(sobol_second_reversed(i), words.y);
    return uvec2(bitfieldReverse(first), bitfieldReverse(second));
}

/// Two words, for `dimension` (even) and the next one.
FN uvec2 sample_bits_2d(IN(Sampler) s, uint dimension) {
    if (s.kind == SAMPLER_SOBOL && dimension < SOBOL_MAX_DIMENSION) {
        return sobol_bits_2d(s, dimension);
    }
    if (s.kind == SAMPLER_HAMMERSLEY && dimension < DIMENSION_VERTEX && s.sample_index < s.sample_count &&
        s.sample_count <= HAMMERSLEY_MAX_COUNT) {
        return hammersley_bits_2d(s, dimension);
    }
    return independent_bits_2d(s, dimension);
}

/// sample_bits_2d of four pairs of dimensions: `dimension`, and those 2, 4 and 6 above it.
struct FourPairs {
    uvec4 first;
    uvec4 second;
};

FN FourPairs sample_bits_four_pairs(IN(Sampler) s, uint dimension) {
    uint first[4];
    uint second[4];
    if (s.kind == SAMPLER_SOBOL && dimension + 6u < SOBOL_MAX_DIMENSION) {
        for (uint i = 0u; i < 4u; i++) {  // without branches, so that a CPU vectorises the loop
            uvec2 bits = sobol_bits_2d(s, dimension + 2u * i);
            first[i] = bits.x;
            second[i] = bits.y;
        }
    } else {
        for (uint i = 0u; i < 4u; i++) {
            uvec2 bits = sample_bits_2d(s, dimension + 2u * i);
            first[i] = bits.x;
            second[i] = bits.y;
        }
    }
    FourPairs pairs;
    pairs.first = uvec4(first[0], first[1], first[2], first[3]);
    pairs.second = uvec4(second[0], second[1], second[2], second[3]);
    return pairs;
}

/// Two numbers in [0, 1), multiples of 2^-24.
FN vec2 sample_2d(IN(Sampler) s, uint dimension) {
    uvec2 bits = sample_bits_2d(s, dimension);
    return vec2(unit_float(bits.x), unit_float(bits.y));
}

/// The first number of sample_2d.
FN float sample_1d(IN(Sampler) s, uint dimension) {
    uvec2 bits = sample_bits_2d(s, dimension);
    return unit_float(bits.x);
}

SHARED_END

#endif
