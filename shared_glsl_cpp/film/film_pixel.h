// The film's data of one pixel. All sums are exact (numbers/exact_sum.h), so a film depends on which samples it holds,
// not on the order in which they came.
#ifndef FILM_PIXEL_H
#define FILM_PIXEL_H

#include "numbers/exact_sum.h"

SHARED_BEGIN

/// The estimate is sum / samples.
struct FilmPixel {
    ExactSum sum;    // of radiance
    uint samples;    // averaged; dropped samples count in `nonfinite` only
    uint nonfinite;  // dropped: NaN, infinite or negative
    uint rays;       // traced for this pixel, modulo 2^32
    uint ray_wraps;  // how often `rays` has overflowed
};
ASSERT_SIZE(FilmPixel, 92);

/// For the layer of standard errors.
struct FilmMoments {
    ExactSum squares;  // of radiance
};
ASSERT_SIZE(FilmMoments, 76);

/// Sums of the first hit over all samples, including dropped ones. A miss adds nothing.
struct FilmFirstHit {
    FixedSum albedo;
    FixedSum normal;    // shading normal, world space
    ExactScalar depth;  // distance to the camera, metres
};
ASSERT_SIZE(FilmFirstHit, 68);

/// One sample's first hit.
struct FirstHit {
    vec3 albedo;
    vec3 normal;
    float depth;
};

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
    if (is_bad_sample(radiance)) {
        pixel.nonfinite += 1u;
        return false;
    }
    exact_add(pixel.sum, radiance);
    pixel.samples += 1u;
    return true;
}

/// Adds the square of a sample that was kept.
FN void film_add_moments(INOUT(FilmMoments) moments, vec3 radiance) {
    exact_add_square(moments.squares, radiance);
}

FN void film_add_first_hit(INOUT(FilmFirstHit) film, IN(FirstHit) hit) {
    fixed_add(film.albedo, hit.albedo);
    fixed_add(film.normal, hit.normal);
    exact_add(film.depth, hit.depth);
}

SHARED_END

#endif
