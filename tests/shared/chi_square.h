// Pearson's statistic as a normal deviate, for the tests of random numbers and warps.
#pragma once

#include <cmath>
#include <vector>

namespace diptych::tests {

/// Cells that expect fewer than 5 are pooled. Wilson & Hilferty 1931: about N(0, 1) under the hypothesis, large when it
/// fails. Infinity for a count in a cell that expects none.
inline double chi_square_deviate(const std::vector<double>& observed, const std::vector<double>& expected) {
    double statistic = 0, pooled_observed = 0, pooled_expected = 0, cells = 0;
    for (std::size_t i = 0; i < observed.size(); i++) {
        if (expected[i] == 0 && observed[i] > 0) {
            return INFINITY;
        }
        if (expected[i] < 5) {
            pooled_observed += observed[i];
            pooled_expected += expected[i];
            continue;
        }
        statistic += (observed[i] - expected[i]) * (observed[i] - expected[i]) / expected[i];
        cells += 1;
    }
    if (pooled_expected >= 5) {
        statistic += (pooled_observed - pooled_expected) * (pooled_observed - pooled_expected) / pooled_expected;
        cells += 1;
    }
    const double freedom = cells - 1, spread = 2 / (9 * freedom);
    return (std::cbrt(statistic / freedom) - (1 - spread)) / std::sqrt(spread);
}

/// All cells expect the same.
inline double uniform_deviate(const std::vector<double>& observed) {
    double total = 0;
    for (const double count : observed) {
        total += count;
    }
    return chi_square_deviate(observed,
                              std::vector<double>(observed.size(), total / static_cast<double>(observed.size())));
}

/// What a deviate of fixed seeds must stay below: one in 3.4 million tests would pass it by chance.
constexpr double deviate_limit = 5;

}  // namespace diptych::tests
