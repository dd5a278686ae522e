// One plain line on how far two pictures differ.
#pragma once

#include <optional>
#include <string>

#include "image/metrics.h"

namespace diptych::core::app {

/// At or beyond it, in any channel, a difference of the means is not put down to noise.
inline constexpr double noise_limit = 4;

struct Verdict {
    std::string text;
    std::optional<bool> noise;         // nothing where it cannot be told
    bool same_random_numbers = false;  // the noise is shared, so z means nothing
    bool correlated = false;  // a picture's samples depend on one another, so its standard errors are too small
};

/// Largest |z| over the channels; NaN where one is unknown.
double largest_z(const Difference& difference);

/// The metadata say whether both drew the same random numbers.
Verdict judge(const Difference& difference, const LayeredImage& a, const LayeredImage& b);

}  // namespace diptych::core::app
