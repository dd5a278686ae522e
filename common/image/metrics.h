// How far two pictures differ, and whether that is noise.
#pragma once

#include <array>
#include <cstddef>

#include "image/layered_image.h"

namespace diptych::core {

/// Of picture a against the reference b, over the pixels where both are finite. All sums in double; means over pixels
/// and channels. NaN means unknown (nothing to divide by, no standard errors).
struct Difference {
    double mse;                        // mean (a-b)^2
    double relmse;                     // mean (a-b)^2 / (b^2 + 1e-2)
    double relmse_trimmed;             // relmse without the 0.1 % of pixels (rounded down) whose error is largest
    double trimmed_energy;             // share of the sum of |a| that these pixels hold
    std::array<double, 3> mean_ratio;  // mean(a) / mean(b)
    /// (mean(a) - mean(b)) over its standard error, sqrt(sum of both files' squared standard errors) / N. Assumes that
    /// the two are independent; +-inf where unequal means are claimed to be exact.
    std::array<double, 3> z_mean;
    double fraction_equal;  // pixels with |a-b| <= 1e-3 max(|a|, |b|) + 1e-6 in every channel
    size_t nonfinite;       // pixels left out because a or b is not finite there
};

/// Throws an Error unless both have the same size and three channels.
Difference compare_images(const LayeredImage& a, const LayeredImage& b);

}  // namespace diptych::core
