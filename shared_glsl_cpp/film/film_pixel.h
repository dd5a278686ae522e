// What a pixel keeps. Sums are pairs of floats (Dekker 1971), so that they hold beyond 10^7 samples in fp32, and squares are taken
// about the pixel's first sample, so that the variance of a constant pixel is exactly zero.
#ifndef FILM_PIXEL_H
#define FILM_PIXEL_H

#include "language/compat.h"

SHARED_BEGIN

/// Radiance sums; the estimate is (sum + compensation) / (samples), where dropped samples count as none.
struct FilmPixel {
    vec3 sum;
    vec3 compensation;
    uint samples;     // averaged; dropped ones are in `nonfinite`
    uint nonfinite;   // dropped: NaN, infinite, negative, or more than the sum holds
    uint rays;        // traced for this pixel, modulo 2^32
    uint ray_wraps;   // and how often that count began anew
};
ASSERT_SIZE(FilmPixel, 40);

/// Second moments about `first`, for the layer of standard errors.
struct FilmMoments {
    vec3 first;
    vec3 sum_squares;  // of (x - first)
    vec3 compensation;
};
ASSERT_SIZE(FilmMoments, 36);

/// Means of the first hit over all samples, dropped ones included; a miss counts as zero. Running means, not sums, so that they hold
/// for any number of samples.
struct FilmFirstHit {
    vec3 albedo;
    vec3 normal;  // shading normal, world
    float depth;  // distance to the camera, metres
};
ASSERT_SIZE(FilmFirstHit, 28);

/// One sample's first hit.
struct FirstHit {
    vec3 albedo;
    vec3 normal;
    float depth;
};

/// sum + compensation += x, componentwise. What the sum loses is carried over, and the pair is normalised, so that the
/// compensation stays below half an ulp of the sum: left to grow, it would round like any fp32 sum.
FN void compensated_add(INOUT(vec3) sum, INOUT(vec3) compensation, vec3 x) {
    PRECISE vec3 t = sum + x;
    PRECISE vec3 from_sum = (sum - t) + x;
    PRECISE vec3 from_x = (x - t) + sum;
    PRECISE vec3 low = compensation;
    low.x += abs(sum.x) >= abs(x.x) ? from_sum.x : from_x.x;
    low.y += abs(sum.y) >= abs(x.y) ? from_sum.y : from_x.y;
    low.z += abs(sum.z) >= abs(x.z) ? from_sum.z : from_x.z;
    PRECISE vec3 high = t + low;
    PRECISE vec3 rest = low - (high - t);
    sum = MUTANT(FILM_SUMS_PLAIN, high, t);
    compensation = MUTANT(FILM_SUMS_PLAIN, rest, vec3(0.0f, 0.0f, 0.0f));
}

/// NaN, infinity or negative, by the bits: a compiler may fold `isnan` away.
FN bool is_bad_component(float x) {
    uint bits = floatBitsToUint(x);
    return (bits & 0x7fffffffu) >= 0x7f800000u || ((bits >> 31) != 0u && (bits & 0x7fffffffu) != 0u);
}

FN bool is_bad_sample(vec3 x) { return is_bad_component(x.x) || is_bad_component(x.y) || is_bad_component(x.z); }

/// Adds one sample; a bad one is dropped and counted. Returns whether it was kept.
FN bool film_add(INOUT(FilmPixel) pixel, vec3 radiance, uint rays) {
    pixel.rays += rays;
    pixel.ray_wraps += pixel.rays < rays ? 1u : 0u;
    if (is_bad_sample(radiance) || is_bad_sample(pixel.sum + radiance)) {
        pixel.nonfinite += 1u;
        return false;
    }
    compensated_add(pixel.sum, pixel.compensation, radiance);
    pixel.samples += 1u;
    return true;
}

/// Adds a kept sample's square; `samples` is the count that already includes it.
FN void film_add_moments(INOUT(FilmMoments) moments, vec3 radiance, uint samples) {
    if (samples == 1u) {
        moments.first = radiance;
    }
    vec3 deviation = radiance - moments.first;
    compensated_add(moments.sum_squares, moments.compensation, deviation * deviation);
}

/// `samples` is the count that already includes this one.
FN void film_add_first_hit(INOUT(FilmFirstHit) film, IN(FirstHit) hit, uint samples) {
    float share = 1.0f / float(samples);
    film.albedo += share * (hit.albedo - film.albedo);
    film.normal += share * (hit.normal - film.normal);
    film.depth += share * (hit.depth - film.depth);
}

SHARED_END

#endif
