// Sums that do not depend on the order of their terms, so that any division of the samples among calls, files and
// machines has the bits of one run. Floats are cut into digits to base 2^32, and each digit has a sum of 64 bits, which
// holds 2^32 terms (a binned sum: Demmel and Nguyen 2015, "Parallel Reproducible Summation", with integers for bins).
// Three bins follow the largest term. Lower digits are left out: each term is kept to 2^-64 of the largest.
#ifndef EXACT_SUM_H
#define EXACT_SUM_H

#include "numbers/elementary.h"

SHARED_BEGIN

/// Bin k sums digit base + k. Digit d has the weight 2^(32 d - 149), or 2^(32 d - 298) in a sum of squares. Zero bits are
/// the empty sum.
struct ExactSum {
    uvec3 low[3];   // lower words of the bins
    uvec3 high[3];  // upper words
    uint base;
};
ASSERT_SIZE(ExactSum, 76);

/// The same for a scalar, in two bins: each term is kept to 2^-32 of the largest.
struct ExactScalar {
    uvec2 low;
    uvec2 high;
    uint base;
};
ASSERT_SIZE(ExactScalar, 20);

/// A sum of vectors of small numbers: 64 bits in two's complement, in units of 2^-28.
struct FixedSum {
    uvec3 low;
    uvec3 high;
};
ASSERT_SIZE(FixedSum, 24);

/// Digit `digit` to base 2^32 of m 2^position.
FN uint digit_of(uint m, int position, int digit) {
    int right = 32 * digit - position;
    if (right >= 0) {
        return right < 32 ? m >> uint(right) : 0u;
    }
    return right > -32 ? m << uint(-right) : 0u;
}

/// |x| = float_mantissa(x) 2^(float_position(x) - 149).
FN uint float_mantissa(float x) {
    uint bits = floatBitsToUint(x);
    return (bits & 0x7fffffu) | ((bits & 0x7f800000u) != 0u ? 0x800000u : 0u);
}

FN int float_position(float x) {
    int exponent = int((floatBitsToUint(x) >> 23) & 0xffu);
    return exponent > 0 ? exponent - 1 : 0;
}

FN uint carry_of(uint sum, uint term) {
    return MUTANT(FILM_CARRY_LOST, sum < term ? 1u : 0u, 0u);
}

FN void add_words(INOUT(uvec3) low, INOUT(uvec3) high, uvec3 term) {
    low += term;
    high += uvec3(carry_of(low.x, term.x), carry_of(low.y, term.y), carry_of(low.z, term.z));
}

/// Makes room for a term whose highest digit is `highest`.
FN void raise_base(INOUT(ExactSum) s, int highest) {
    while (int(s.base) < highest - 2) {
        s.low[0] = s.low[1];
        s.high[0] = s.high[1];
        s.low[1] = s.low[2];
        s.high[1] = s.high[2];
        s.low[2] = uvec3(0u, 0u, 0u);
        s.high[2] = uvec3(0u, 0u, 0u);
        s.base += 1u;
    }
}

FN void raise_base(INOUT(ExactScalar) s, int highest) {
    while (int(s.base) < highest - 1) {
        s.low = uvec2(s.low.y, 0u);
        s.high = uvec2(s.high.y, 0u);
        s.base += 1u;
    }
}

/// s += x, of finite components >= 0.
FN void exact_add(INOUT(ExactSum) s, vec3 x) {
    raise_base(s, (float_position(max_component(x)) + 23) / 32);
    uvec3 m = uvec3(float_mantissa(x.x), float_mantissa(x.y), float_mantissa(x.z));
    int at_x = float_position(x.x);
    int at_y = float_position(x.y);
    int at_z = float_position(x.z);
    for (int k = 0; k < 3; ++k) {
        int digit = int(s.base) + k;
        add_words(s.low[k], s.high[k],
                  uvec3(digit_of(m.x, at_x, digit), digit_of(m.y, at_y, digit), digit_of(m.z, at_z, digit)));
    }
}

/// Digit of x², whose mantissa has 48 bits.
FN uint square_digit(float x, int digit) {
    uint m = float_mantissa(x);
    int position = 2 * float_position(x);
    return digit_of(m * m, position, digit) | digit_of(multiply_high(m, m), position + 32, digit);
}

/// s += x², componentwise, for finite components.
FN void exact_add_square(INOUT(ExactSum) s, vec3 x) {
    raise_base(s, (2 * float_position(max_component(x)) + 47) / 32);
    for (int k = 0; k < 3; ++k) {
        int digit = int(s.base) + k;
        add_words(s.low[k], s.high[k],
                  uvec3(square_digit(x.x, digit), square_digit(x.y, digit), square_digit(x.z, digit)));
    }
}

/// s += x, finite and >= 0.
FN void exact_add(INOUT(ExactScalar) s, float x) {
    raise_base(s, (float_position(x) + 23) / 32);
    uvec2 term = uvec2(digit_of(float_mantissa(x), float_position(x), int(s.base)),
                       digit_of(float_mantissa(x), float_position(x), int(s.base) + 1));
    s.low += term;
    s.high += uvec2(carry_of(s.low.x, term.x), carry_of(s.low.y, term.y));
}

/// x in units of 2^-28, to the nearest. Beyond 7.9 either way it is clamped.
FN int fixed_point(float x) {
    return int(floor(clamp(x, -7.9f, 7.9f) * 268435456.0f + 0.5f));
}

FN void fixed_add(INOUT(FixedSum) s, vec3 x) {
    int at_x = fixed_point(x.x);
    int at_y = fixed_point(x.y);
    int at_z = fixed_point(x.z);
    add_words(s.low, s.high, uvec3(uint(at_x), uint(at_y), uint(at_z)));
    s.high += uvec3(at_x < 0 ? NONE : 0u, at_y < 0 ? NONE : 0u, at_z < 0 ? NONE : 0u);  // the sign, extended
}

SHARED_END

#endif
