// Distribution functions and quantiles of the normal, Student, chi-square and F distributions. `_upper` is the
// probability of a larger value, computed without cancellation. NaN arguments give NaN.
#pragma once

namespace diptych::core {

double normal_cdf(double z);
double normal_upper(double z);
/// p in (0, 1); relative error about 1e-15.
double normal_quantile(double p);

/// Probability of |T| >= |t| with `freedom` > 0 degrees (DLMF 8.17: I_x(freedom/2, 1/2) at x = freedom/(freedom + t²)).
double student_two_sided(double t, double freedom);
double student_cdf(double t, double freedom);
/// p in (0, 1).
double student_quantile(double p, double freedom);

double chi_square_upper(double x, double freedom);
/// p in (0, 1).
double chi_square_quantile(double p, double freedom);

double f_upper(double f, double numerator_freedom, double denominator_freedom);

}  // namespace diptych::core
