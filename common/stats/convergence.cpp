#include "stats/convergence.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "stats/distributions.h"
#include "stats/welch.h"

namespace diptych::core {

namespace {

std::vector<double> sums_over_runs(const ErrorTable& errors, std::size_t counts) {
    std::vector<double> sums(counts, 0);
    for (const std::vector<double>& run : errors) {
        for (std::size_t i = 0; i < counts; ++i) {
            sums[i] += run[i];
        }
    }
    return sums;
}

/// Slope of y on x by least squares.
double slope(std::span<const double> x, std::span<const double> y) {
    const double n = static_cast<double>(x.size());
    double mean_x = 0, mean_y = 0, across = 0, along = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        mean_x += x[i] / n;
        mean_y += y[i] / n;
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
        across += (x[i] - mean_x) * (y[i] - mean_y);
        along += (x[i] - mean_x) * (x[i] - mean_x);
    }
    return across / along;
}

/// The line y = a + c x through one run, with x = 1/N and weights N².
struct Line {
    double a = 0;
    double c = 0;
};

Line weighted_line(std::span<const double> samples, std::span<const double> y) {
    double w = 0, wx = 0, wxx = 0, wy = 0, wxy = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double n = samples[i];
        w += n * n;
        wx += n;
        wxx += 1;
        wy += n * n * y[i];
        wxy += n * y[i];
    }
    const double determinant = w * wxx - wx * wx;
    return {(wxx * wy - wx * wxy) / determinant, (w * wxy - wx * wy) / determinant};
}

double line_in_logarithms(double x0, double y0, double x1, double y1, double x) {
    const double t = (std::log(x) - std::log(x0)) / (std::log(x1) - std::log(x0));
    return std::exp(std::log(y0) + t * (std::log(y1) - std::log(y0)));
}

}  // namespace

Interval mean_interval(std::span<const double> values, double confidence) {
    Interval interval;
    if (values.empty()) {
        return interval;
    }
    const SampleSummary summary = summarize(values);
    interval.value = summary.mean;
    if (values.size() > 1) {
        const double half =
            std::sqrt(summary.variance / summary.count) * student_quantile((1 + confidence) / 2, summary.count - 1);
        interval.low = summary.mean - half;
        interval.high = summary.mean + half;
    }
    return interval;
}

double median(std::vector<double> values) {
    if (values.empty()) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

Interval log_slope(std::span<const double> samples, const ErrorTable& errors, const std::vector<bool>& usable,
                   double confidence) {
    const std::size_t runs = errors.size();
    const std::vector<double> sums = sums_over_runs(errors, samples.size());
    std::vector<std::size_t> kept;
    std::vector<double> x;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const bool positive = sums[i] > 0 && std::all_of(errors.begin(), errors.end(),
                                                         [&](const auto& run) { return sums[i] - run[i] > 0; });
        if (usable[i] && positive) {
            kept.push_back(i);
            x.push_back(std::log(samples[i]));
        }
    }
    Interval interval;
    if (kept.size() < 3 || runs < 2) {
        return interval;
    }
    const auto slope_without = [&](const std::vector<double>* run) {
        std::vector<double> y;
        for (const std::size_t i : kept) {
            y.push_back(std::log(sums[i] - (run != nullptr ? (*run)[i] : 0)));  // a factor shifts all logarithms alike
        }
        return slope(x, y);
    };
    std::vector<double> without;
    for (const std::vector<double>& run : errors) {
        without.push_back(slope_without(&run));
    }
    const double freedom = static_cast<double>(runs) - 1;
    const double variance = summarize(without).variance * freedom * freedom / static_cast<double>(runs);
    const double half = std::sqrt(variance) * student_quantile((1 + confidence) / 2, freedom);
    interval.value = slope_without(nullptr);
    interval.low = interval.value - half;
    interval.high = interval.value + half;
    return interval;
}

BiasFit fit_bias(std::span<const double> samples, const ErrorTable& errors, double common_error, double confidence) {
    BiasFit fit;
    if (samples.size() < 2 || errors.size() < 2) {
        return fit;
    }
    std::vector<double> biases, noises;
    for (const std::vector<double>& run : errors) {
        const Line line = weighted_line(samples, run);
        biases.push_back(line.a);
        noises.push_back(line.c);
    }
    const SampleSummary bias = summarize(biases);
    const double own = bias.variance / bias.count;
    const double all = own + common_error * common_error;
    fit.noise = summarize(noises).mean;
    fit.standard_error = std::sqrt(all);
    fit.bias_squared.value = bias.mean;
    if (all == 0) {
        fit.p = bias.mean > 0 ? 0 : 1;
        fit.bias_squared.low = fit.bias_squared.high = bias.mean;
        return fit;
    }
    // Welch and Satterthwaite, the common part known; a huge number stands for the normal distribution.
    const double freedom = own > 0 ? std::min(1e6, (bias.count - 1) * (all / own) * (all / own)) : 1e6;
    const double half = fit.standard_error * student_quantile((1 + confidence) / 2, freedom);
    fit.bias_squared.low = bias.mean - half;
    fit.bias_squared.high = bias.mean + half;
    fit.p = student_cdf(-bias.mean / fit.standard_error, freedom);
    return fit;
}

TargetTime time_to_target(std::span<const double> seconds, std::span<const double> errors, double target) {
    TargetTime result;
    if (seconds.empty() || !(target > 0)) {
        return result;
    }
    if (errors.front() <= target) {
        return {TargetTime::Kind::earlier, seconds.front()};
    }
    for (std::size_t i = 1; i < seconds.size(); ++i) {
        if (errors[i] <= target && errors[i] > 0) {
            return {TargetTime::Kind::reached,
                    line_in_logarithms(errors[i - 1], seconds[i - 1], errors[i], seconds[i], target)};
        }
    }
    return {TargetTime::Kind::later, seconds.back()};
}

}  // namespace diptych::core
