// The film's data of one pixel. Sums are pairs of floats (Dekker 1971), so that they stay accurate beyond 10^7 samples
// in fp32. Squares are taken about the pixel's first sample, so that the variance of a constant pixel is exactly zero.
#ifndef FILM_PIXEL_H
#define FILM_PIXEL_H

#include "language/compat.h"

SHARED_BEGIN

/// Radiance sums. The estimate is (sum + compensation) / samples.
struct FilmPixel {
    vec3 sum;
    vec3 compensation;
    uint samples;     // averaged; dropped samples count in `nonfinite` only
    uint nonfinite;   // dropped: NaN, infinite, negative, or too large for the sum
    uint rays;        // traced for this pixel, modulo 2^32
    uint ray_wraps;   // how often `rays` has overflowed
};
ASSERT_SIZE(FilmPixel, 40);

/// Second moments about `first`, for the layer of standard errors.
struct FilmMoments {
    vec3 first;
    vec3 sum_squares;  // of (x - first)
    vec3 compensation;
};
ASSERT_SIZE(FilmMoments, 36);

/// Means of the first hit over all samples, including dropped ones; a miss counts as zero. These are running means,
/// not sums, so that they stay accurate for any number of samples.
struct FilmFirstHit {
    vec3 albedo;
    vec3 normal;  // shading normal, world space
    float depth;  // distance to the camera, metres
};
ASSERT_SIZE(FilmFirstHit, 28);

/// One sample's first hit.
struct FirstHit {
    vec3 albedo;
    vec3 normal;
    float depth;
};

/// sum + compensation += x, componentwise. The rounding error of the sum goes into the compensation. The pair is
/// normalised, so that the compensation stays below half an ulp of the sum; a larger one would round like any fp32
/// sum.
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

/// Whether x is NaN, infinite or negative. Tested by the bits, because a compiler may remove `isnan`.
FN bool is_bad_component(float x) {
    uint bits = floatBitsToUint(x);
    return (bits & 0x7fffffffu) >= 0x7f800000u || ((bits >> 31) != 0u && (bits & 0x7fffffffu) != 0u);
}

FN bool is_bad_sample(vec3 x) { return is_bad_component(x.x) || is_bad_component(x.y) || is_bad_component(x.z); }

/// Adds one sample. A bad sample is dropped and counted. Returns whether the sample was kept.
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

/// Adds the square of a sample that was kept. `samples` is the count that already includes it.
FN void film_add_moments(INOUT(FilmMoments) moments, vec3 radiance, uint samples) {
    if (samples == 1u) {
        moments.first = radiance;
    }
    vec3 deviation = radiance - moments.first;
    compensated_add(moments.sum_squares, moments.compensation, deviation * deviation);
}

/// `samples` is the count that already includes this sample.
FN void film_add_first_hit(INOUT(FilmFirstHit) film, IN(FirstHit) hit, uint samples) {
    float share = 1.0f / float(samples);
    film.albedo += share * (hit.albedo - film.albedo);
    film.normal += share * (hit.normal - film.normal);
    film.depth += share * (hit.depth - film.depth);
}

SHARED_END

#endif
