// How an error falls with the number of samples: bands, slopes, what of it is bias, and when it reaches a target.
#pragma once

#include <limits>
#include <span>
#include <vector>

namespace diptych::core {

/// A number and its confidence interval; NaN where nothing can be said.
struct Interval {
    double value = std::numeric_limits<double>::quiet_NaN();
    double low = std::numeric_limits<double>::quiet_NaN();
    double high = std::numeric_limits<double>::quiet_NaN();
};

/// errors[r][i]: of run r, a render with a seed of its own, after samples[i]. One run's errors depend on one another,
/// the runs do not: they are the unit of every interval.
using ErrorTable = std::vector<std::vector<double>>;

/// Mean of independent values with Student's interval; the ends are NaN below two.
Interval mean_interval(std::span<const double> values, double confidence = 0.95);

/// The middle value, or the mean of both; NaN for none.
double median(std::vector<double> values);

/// Least squares of log(mean over the runs) on log(samples), over the counts where `usable` says so and every mean that
/// leaves one run out is positive too. The interval is the jackknife's over the runs (Tukey 1958): s² = (K-1)/K sum
/// (slope without r - their mean)², with Student's quantile of K-1. NaN with fewer than three such counts or two runs.
Interval log_slope(std::span<const double> samples, const ErrorTable& errors, const std::vector<bool>& usable,
                   double confidence = 0.95);

/// error(N) = bias² + noise / N.
struct BiasFit {
    Interval bias_squared;
    double noise = std::numeric_limits<double>::quiet_NaN();
    double standard_error = std::numeric_limits<double>::quiet_NaN();  // of bias²
    double p = std::numeric_limits<double>::quiet_NaN();  // one-sided: of so much or more where there is no bias
};

/// Least squares for each run by itself with weights N², as the error's spread is as large as the error, that is as
/// 1/N; the mean and its spread over the runs. The weights hang on no result, so bias² has the expectation 0 where
/// there is none. `common_error` is the standard error of what all runs share (the reference's noise). NaN with fewer
/// than two counts or runs.
BiasFit fit_bias(std::span<const double> samples, const ErrorTable& errors, double common_error = 0,
                 double confidence = 0.95);

/// When a falling curve passes `target`: between two points by a line in logarithms.
struct TargetTime {
    enum class Kind { reached, earlier, later, unknown };
    Kind kind = Kind::unknown;
    double seconds = std::numeric_limits<double>::quiet_NaN();  // earlier: than the first point; later: than the last
};

TargetTime time_to_target(std::span<const double> seconds, std::span<const double> errors, double target);

}  // namespace diptych::core
