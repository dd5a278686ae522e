// The film's exact sums as floats, for the display.
#ifndef FILM_VALUES_GLSL
#define FILM_VALUES_GLSL

#include "film/film_pixel.h"

// x 2^exponent, in two steps, since either factor alone may leave the range of a float.
float scaled(float x, int exponent) {
    int half_way = exponent / 2;
    return ldexp(ldexp(x, half_way), exponent - half_way);
}

vec3 scaled(vec3 x, int exponent) {
    return vec3(scaled(x.x, exponent), scaled(x.y, exponent), scaled(x.z, exponent));
}

// A number as an unevaluated sum of two floats, x + y, to 48 bits (Dekker 1971).
vec2 pair_sum(float a, float b) {
    precise float sum = a + b;
    precise float from_b = sum - a;
    precise float error = (a - (sum - from_b)) + (b - from_b);
    return vec2(sum, error);
}

vec2 pair_sum(vec2 a, vec2 b) {
    vec2 high = pair_sum(a.x, b.x);
    precise float low = high.y + (a.y + b.y);
    return pair_sum(high.x, low);
}

// The upper 12 bits of a float's mantissa.
float upper_half(float x) {
    return uintBitsToFloat(floatBitsToUint(x) & 0xfffff000u);
}

vec2 pair_product(vec2 a, vec2 b) {
    precise float high = a.x * b.x;
    float a_upper = upper_half(a.x);
    float b_upper = upper_half(b.x);
    precise float a_lower = a.x - a_upper;
    precise float b_lower = b.x - b_upper;
    precise float error = ((a_upper * b_upper - high) + a_upper * b_lower + a_lower * b_upper) + a_lower * b_lower;
    precise float low = error + (a.x * b.y + a.y * b.x);
    return pair_sum(high, low);
}

vec2 pair_of_word(uint word) {
    return pair_sum(float(word >> 16) * 65536.0, float(word & 0xffffu));
}

// One channel's bins, in units of 2^32 times the highest bin's.
vec2 pair_of_bins(ExactSum s, int channel) {
    vec2 value = vec2(0.0f);
    float weight = 1.0f;
    for (int k = 2; k >= 0; --k) {
        value = pair_sum(value, pair_of_word(s.high[k][channel]) * weight);
        weight *= 2.3283064365386963e-10f;  // 2^-32
        value = pair_sum(value, pair_of_word(s.low[k][channel]) * weight);
    }
    return value;
}

// The exponent of that unit in a sum.
int unit_exponent(ExactSum s) {
    return 32 * (int(s.base) + 3) - 149;
}

vec3 film_mean(FilmPixel pixel) {
    if (pixel.samples == 0u) {
        return vec3(0.0f);
    }
    vec3 sum = vec3(pair_of_bins(pixel.sum, 0).x, pair_of_bins(pixel.sum, 1).x, pair_of_bins(pixel.sum, 2).x);
    return scaled(sum / float(pixel.samples), unit_exponent(pixel.sum));
}

// As pixel_standard_error, but in pairs of floats; NaN below two samples.
vec3 film_standard_error(FilmPixel pixel, FilmMoments moments) {
    if (pixel.samples < 2u) {
        return vec3(uintBitsToFloat(0x7fc00000u));
    }
    float n = float(pixel.samples);
    // From the unit of the squares to the square of the sum's unit.
    int exponent = 32 * (int(moments.squares.base) + 3) - 298 - 2 * unit_exponent(pixel.sum);
    vec3 error;
    for (int channel = 0; channel < 3; ++channel) {
        vec2 sum = pair_of_bins(pixel.sum, channel);
        vec2 squares = pair_of_bins(moments.squares, channel);
        squares = vec2(scaled(squares.x, exponent), scaled(squares.y, exponent));
        vec2 difference = pair_sum(pair_product(vec2(n, 0.0f), squares), -pair_product(sum, sum));
        error[channel] = sqrt(max(difference.x, 0.0f) / (n - 1.0f)) / n;
    }
    return scaled(error, unit_exponent(pixel.sum));
}

vec3 film_mean(FixedSum s, float n) {
    return (vec3(ivec3(s.high)) * 4294967296.0f + vec3(s.low)) / (268435456.0f * n);
}

float film_mean(ExactScalar s, float n) {
    float sum = float(s.high.y) + (float(s.low.y) + float(s.high.x)) * 2.3283064365386963e-10f +
                float(s.low.x) * 5.421010862427522e-20f;
    return scaled(sum / n, 32 * (int(s.base) + 2) - 149);
}

#endif
