// The square of a renderer's bias, without bias, from independent renders.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace diptych::core {

/// Sums over K renders with seeds of their own, of D = X - R for every value of the picture; R is the reference.
/// Deviations, so that nothing cancels in single precision.
struct DeviationSums {
    std::uint32_t runs = 0;
    std::vector<float> sum;      // of D
    std::vector<float> squares;  // of D²
    std::vector<float> largest;  // D² of the run where it is largest

    void add(std::span<const float> deviations);
};

struct BiasSquared {
    double value = std::numeric_limits<double>::quiet_NaN();
    double standard_error = std::numeric_limits<double>::quiet_NaN();
    double p = std::numeric_limits<double>::quiet_NaN();  // one-sided: of so much or more where there is no bias
    double heavy =
        std::numeric_limits<double>::quiet_NaN();  // share of the values where one run holds over half of the sum of D²
};

/// The mean over all values of
///     w ((S1² - S2) / (K (K-1)) - V),    w = `weights` (1 where there are none), S1 = sum D, S2 = sum D², V =
///     `reference_variance`.
/// The first part is the mean of D_i D_j over all pairs of different runs, whose expectation is (E X - R)²; R's own
/// noise adds its variance to that, and V takes it away again. So the expectation is the mean squared bias, whatever
/// the noise (four renders at a time, this is mean((A1-R1)(A2-R2))). The weights 1 / (R² + 1e-2) of relMSE keep the
/// noise of a few bright values from hiding the bias of the others.
///
/// The standard error comes from the means of blocks of `block` x `block` pixels, which no noise connects (`block` 1
/// where pixels have random numbers of their own): values of `channels` a pixel, rows of `width` pixels. NaN with fewer
/// than eight blocks or two runs.
///
/// Rare bright samples that no run has met yet make all runs too dark in one way, which looks like a bias until enough
/// are met: `heavy` tells. Of normal noise and 16 runs it is about 1 %.
BiasSquared bias_squared(const DeviationSums& sums, std::span<const float> reference_variance,
                         std::span<const float> weights, int width, int channels, int block);

}  // namespace diptych::core
