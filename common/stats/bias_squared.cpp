#include "stats/bias_squared.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "stats/distributions.h"
#include "stats/welch.h"

namespace diptych::core {

namespace {

constexpr std::size_t least_blocks = 8;

}  // namespace

void DeviationSums::add(std::span<const float> deviations) {
    sum.resize(deviations.size());
    squares.resize(deviations.size());
    largest.resize(deviations.size());
    for (std::size_t i = 0; i < deviations.size(); ++i) {
        const float square = deviations[i] * deviations[i];
        sum[i] += deviations[i];
        squares[i] += square;
        largest[i] = std::max(largest[i], square);
    }
    ++runs;
}

BiasSquared bias_squared(const DeviationSums& sums, std::span<const float> reference_variance,
                         std::span<const float> weights, int width, int channels, int block) {
    BiasSquared result;
    if (sums.runs < 2 || sums.sum.empty()) {
        return result;
    }
    const double pairs = static_cast<double>(sums.runs) * (sums.runs - 1);
    const int height = static_cast<int>(sums.sum.size()) / (width * channels);
    const int columns = (width + block - 1) / block;
    std::vector<double> totals(static_cast<std::size_t>(columns) *
                               static_cast<std::size_t>((height + block - 1) / block));
    std::size_t heavy = 0, noisy = 0;
    for (std::size_t i = 0; i < sums.sum.size(); ++i) {
        const std::size_t pixel = i / static_cast<std::size_t>(channels);
        const std::size_t x = pixel % static_cast<std::size_t>(width), y = pixel / static_cast<std::size_t>(width);
        const double s1 = sums.sum[i];
        const std::size_t side = static_cast<std::size_t>(block);
        totals[y / side * static_cast<std::size_t>(columns) + x / side] +=
            ((s1 * s1 - sums.squares[i]) / pairs - reference_variance[i]) * (weights.empty() ? 1.0 : weights[i]);
        noisy += sums.squares[i] > 0 ? 1 : 0;
        heavy += sums.largest[i] > sums.squares[i] / 2 ? 1 : 0;
    }
    const double blocks = static_cast<double>(totals.size());
    const SampleSummary summary = summarize(totals);
    const double values_a_block = static_cast<double>(sums.sum.size()) / blocks;
    result.value = summary.mean / values_a_block;
    result.heavy = noisy > 0 ? static_cast<double>(heavy) / static_cast<double>(noisy) : 0;
    if (totals.size() >= least_blocks) {
        result.standard_error = std::sqrt(summary.variance / blocks) / values_a_block;
        result.p = result.standard_error > 0 ? student_cdf(-result.value / result.standard_error, blocks - 1)
                   : result.value > 0        ? 0
                                             : 1;
    }
    return result;
}

}  // namespace diptych::core
