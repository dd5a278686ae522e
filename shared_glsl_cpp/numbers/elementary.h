// Elementary functions as polynomials. Vulkan's own functions may be off by thousands of ulps, and differ from C++'s.
// These use only +, -, *, /, sqrt and integer operations, so the backends agree except for the rounding of division
// and sqrt. Coefficients are minimax in relative error (Remez exchange), rounded to fp32. Error bounds were measured
// against double over the stated range, in ulps of the exact result.
#ifndef ELEMENTARY_H
#define ELEMENTARY_H

#include "language/compat.h"

SHARED_BEGIN

CONST float HALF_PI = 1.57079632679490f;
CONST float QUARTER_PI = 0.785398163397448f;
CONST float LOG2_E = 1.44269504088896f;
CONST float SIN_COS_MAX = 16384.0f;  // beyond it, sin_cos returns the values for 0

/// Tested by the bits, because a compiler may remove `isnan`.
FN bool is_nan(float x) {
    return (floatBitsToUint(x) & 0x7fffffffu) > 0x7f800000u;
}

FN float positive_infinity() {
    return uintBitsToFloat(0x7f800000u);
}

/// sqrt(max(0, x)).
FN float safe_sqrt(float x) {
    return x > 0.0f ? sqrt(x) : 0.0f;
}

/// Relative luminance of linear Rec.709.
FN float luminance(vec3 rgb) {
    return 0.2126f * rgb.x + 0.7152f * rgb.y + 0.0722f * rgb.z;
}

FN float max_component(vec3 v) {
    return max(v.x, max(v.y, v.z));
}

/// Sine and cosine of r radians, |r| <= pi/4, to 1 ulp.
FN void sin_cos_octant(float r, OUT(float) s, OUT(float) c) {
    PRECISE float z = r * r;
    PRECISE float sine = r + r * z * (-0.166666552f + z * (0.00833215564f + z * -0.00019514632f));
    PRECISE float cosine = 1.0f - (0.5f * z - z * z * (0.0416666456f + z * (-0.00138873095f + z * 2.44324146e-05f)));
    s = sine;
    c = cosine;
}

/// Sine and cosine of x radians, |x| <= SIN_COS_MAX; (0, 1) beyond it and for NaN. The error is at most 1.6 ulp for
/// |x| <= 7, and 3e-7 anywhere. Multiples of pi/2 are subtracted in three parts (Cody and Waite 1980, with the split
/// of Cephes).
FN void sin_cos(float x, OUT(float) s, OUT(float) c) {
    float angle = abs(x) <= SIN_COS_MAX ? x : 0.0f;
    float quadrant = floor(angle * 0.636619772367581f + 0.5f);
    PRECISE float r =
        ((angle - quadrant * 1.5703125f) - quadrant * 4.837512969970703e-4f) - quadrant * 7.54978995489188e-8f;
    float sine;
    float cosine;
    sin_cos_octant(r, sine, cosine);
    int turn = int(quadrant) & 3;
    bool swap = (turn & 1) != 0;
    float sine_part = swap ? cosine : sine;
    float cosine_part = swap ? sine : cosine;
    s = (turn & 2) != 0 ? -sine_part : sine_part;
    c = turn == 1 || turn == 2 ? -cosine_part : cosine_part;
}

/// Angle of (x, y) from the x axis, in [-pi, pi]; 0 for (0, 0). If |x| + |y| is not finite, the result is any finite
/// value or NaN. Error 2.6 ulp.
FN float arctan2(float y, float x) {
    float ax = abs(x);
    float ay = abs(y);
    float small = min(ax, ay);
    float large = max(ax, ay);
    if (large == 0.0f) {
        return 0.0f;
    }
    // tan(a - pi/4) = (t - 1)/(t + 1) halves the polynomial's range.
    bool reduce = small > 0.414213562f * large;
    PRECISE float t = (reduce ? small - large : small) / (reduce ? small + large : large);
    PRECISE float z = t * t;
    PRECISE float series =
        t + t * z * (-0.333333164f + z * (0.199984655f + z * (-0.142434224f + z * (0.105929472f + z * -0.060759183f))));
    PRECISE float angle = reduce ? QUARTER_PI + series : series;
    angle = ay > ax ? HALF_PI - angle : angle;
    angle = x < 0.0f ? PI - angle : angle;
    return y < 0.0f ? -angle : angle;
}

/// In [0, pi]; x is clamped to [-1, 1]. Error 3.4 ulp.
FN float arccos(float x) {
    float clamped = clamp(x, -1.0f, 1.0f);
    return arctan2(safe_sqrt((1.0f - clamped) * (1.0f + clamped)), clamped);
}

/// 2^x; 0 below 2^-126, infinity from 2^128 on, NaN for NaN. Error 1.6 ulp.
FN float exp2_poly(float x) {
    if (is_nan(x)) {
        return x;
    }
    if (x < -126.0f) {
        return 0.0f;
    }
    if (x >= 128.0f) {
        return positive_infinity();
    }
    float whole = floor(x);
    PRECISE float f = x - whole;
    PRECISE float p =
        1.0f +
        f * (0.693147182f +
             f * (0.240226403f +
                  f * (0.0555050224f +
                       f * (0.00961428322f + f * (0.00134190149f + f * (0.000143772166f + f * 2.14305892e-05f))))));
    return p * uintBitsToFloat(uint(int(whole) + 127) << 23);
}

/// ln(1 + f) for 1 + f in [sqrt(1/2), sqrt(2)].
FN float log1p_reduced(float f) {
    PRECISE float tail =
        0.333333135f +
        f * (-0.250000089f +
             f * (0.200021192f +
                  f * (-0.166679859f +
                       f * (0.142195225f +
                            f * (-0.124057561f + f * (0.11888586f + f * (-0.11674802f + f * 0.067445755f)))))));
    PRECISE float result = f - (0.5f * f * f - f * f * f * tail);
    return result;
}

/// Splits a positive normal x = (1 + f) 2^e with 1 + f in [sqrt(1/2), sqrt(2)). Returns e.
FN float split_exponent(float x, OUT(float) f) {
    uint offset = floatBitsToUint(x) - 0x3f3504f3u;
    f = uintBitsToFloat((offset & 0x007fffffu) + 0x3f3504f3u) - 1.0f;
    return float(int(offset) >> 23);
}

/// log2(x). Negative infinity for 0 and denormals; NaN for negative x and NaN. Error 1.8 ulp.
FN float log2_poly(float x) {
    uint bits = floatBitsToUint(x);
    if (bits < 0x00800000u) {
        return -positive_infinity();
    }
    if (bits >= 0x7f800000u) {
        return bits == 0x7f800000u ? x : (bits == 0x80000000u ? -positive_infinity() : uintBitsToFloat(0x7fc00000u));
    }
    float f;
    float exponent = split_exponent(x, f);
    PRECISE float result = exponent + log1p_reduced(f) * LOG2_E;
    return result;
}

/// base^e for base >= 0. 0^0 = 1. Relative error (2 + 1.5 |e log2(base)|) 2^-23.
FN float pow_poly(float base, float e) {
    return e == 0.0f ? 1.0f : exp2_poly(e * log2_poly(base));
}

/// ln(1 + x) for x > -1, accurate for tiny x. Negative infinity at -1; NaN below. Error 3.5 ulp.
FN float log1p_poly(float x) {
    if (x > -0.292893f && x < 0.414213f) {
        return log1p_reduced(x);
    }
    return log2_poly(1.0f + x) * 0.693147180559945f;
}

SHARED_END

#endif
