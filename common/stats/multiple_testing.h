// Many p-values at once: one verdict on all, or corrected ones.
#pragma once

#include <span>
#include <vector>

namespace diptych::core {

/// -2 sum(ln p) (Fisher 1932). A p below 1e-300 counts as 1e-300, so that the sum stays finite.
double fisher_statistic(std::span<const double> p);

/// p of that statistic where the p-values are independent and uniform under the hypothesis: chi-square with 2n degrees.
/// 1 for none.
double fisher_combined(std::span<const double> p);

/// The same whatever the dependence, at a price: e times the geometric mean (Vovk and Wang 2020, "Combining p-values
/// via averaging"). 1 for none.
double merged_p(std::span<const double> p);

/// p of a sum of known mean and variance under the hypothesis, as a scaled chi-square (Brown 1975, "A method for
/// combining non-independent, one-sided tests of significance").
double scaled_chi_square_upper(double statistic, double mean, double variance);

/// Adjusted p-values, in the given order (Holm 1979): rejecting those of at most alpha keeps the chance of any false
/// rejection at alpha, whatever the dependence.
std::vector<double> holm_adjusted(std::span<const double> p);

/// 1 - (1 - p)^n (Šidák 1967): p of the least of n independent p-values.
double sidak_adjusted(double least_p, double n);

/// The p at which each of n independent tests must reject for a family-wise alpha.
double sidak_threshold(double alpha, double n);

}  // namespace diptych::core
