// Integer hashes, equal to the bit on both backends.
#ifndef RNG_H
#define RNG_H

#include "language/compat.h"

SHARED_BEGIN

/// Four words from four words: Jarzynski and Olano 2020, "Hash Functions for GPU Rendering".
FN uvec4 pcg4d(uvec4 v) {
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    v = v ^ (v >> 16u);
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    return v;
}

/// A permutation of the 32-bit words (Wellons 2018, "lowbias32").
FN uint hash_word(uint x) {
    x = x ^ (x >> 16);
    x *= 0x7feb352du;
    x = x ^ (x >> 15);
    x *= 0x846ca68bu;
    return x ^ (x >> 16);
}

/// Hash of an ordered pair. For a fixed value of one word it is a permutation of the other.
FN uint hash_combine(uint a, uint b) {
    return hash_word(hash_word(a + 0x9e3779b9u) + b);
}

/// A number in [0, 1) from the word's high 24 bits.
FN float unit_float(uint bits) {
    return MUTANT(UNIT_FLOAT_OF_ONE, float(bits >> 8) * 5.9604644775390625e-8f, float(bits) * 2.3283064365386963e-10f);
}

SHARED_END

#endif
