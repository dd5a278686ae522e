// Pearson's goodness-of-fit test: do counts follow the expected ones?
#pragma once

#include <vector>

namespace diptych::core {

/// With fewer than two cells to compare, `freedom` is 0 and `p` 1: nothing has been tested.
struct ChiSquareFit {
    double statistic = 0;
    double freedom = 0;
    double p = 1;  // of a statistic as large
};

/// Cells that expect fewer than 5 are pooled into one, and that one with the least of the others where it still expects
/// fewer (Cochran 1954). A count in a cell that expects none: statistic infinite, p 0. Both arrays have the same
/// length.
ChiSquareFit chi_square_fit(const std::vector<double>& observed, const std::vector<double>& expected);

/// All cells expect the same.
ChiSquareFit chi_square_uniform(const std::vector<double>& observed);

/// The statistic as a normal deviate (Wilson & Hilferty 1931): about N(0, 1) under the hypothesis, large when it fails,
/// very negative where counts are more even than chance would have them. Infinity for an impossible count.
double chi_square_deviate(const ChiSquareFit& fit);
double chi_square_deviate(const std::vector<double>& observed, const std::vector<double>& expected);
double uniform_deviate(const std::vector<double>& observed);

/// What a deviate of fixed seeds must stay below: one in 3.4 million tests would pass it by chance.
inline constexpr double deviate_limit = 5;

}  // namespace diptych::core
