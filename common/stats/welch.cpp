#include "stats/welch.h"

#include <cmath>
#include <limits>

#include "stats/distributions.h"

namespace diptych::core {

SampleSummary summarize(std::span<const double> values) {
    SampleSummary summary;
    summary.count = static_cast<double>(values.size());
    for (const double value : values) {
        summary.mean += value / summary.count;
    }
    for (const double value : values) {
        summary.variance += (value - summary.mean) * (value - summary.mean);
    }
    summary.variance = summary.count > 1 ? summary.variance / (summary.count - 1) : 0;
    return summary;
}

WelchTest welch_test(const SampleSummary& a, const SampleSummary& b) {
    const double from_a = a.variance / a.count;
    const double from_b = b.variance / b.count;
    WelchTest test;
    test.difference = a.mean - b.mean;
    test.standard_error = std::sqrt(from_a + from_b);
    if (test.standard_error == 0) {
        test.freedom = std::numeric_limits<double>::infinity();
        test.t = test.difference == 0 ? 0 : std::copysign(test.freedom, test.difference);
        test.p = test.difference == 0 ? 1 : 0;
        return test;
    }
    // In shares, so that no square underflows.
    const double share_a = from_a / (from_a + from_b);
    const double share_b = from_b / (from_a + from_b);
    test.freedom = 1 / (share_a * share_a / (a.count - 1) + share_b * share_b / (b.count - 1));
    test.t = test.difference / test.standard_error;
    test.p = student_two_sided(test.t, test.freedom);
    return test;
}

WelchTest welch_test(std::span<const double> a, std::span<const double> b) {
    return welch_test(summarize(a), summarize(b));
}

double confidence_half_width(const WelchTest& test, double confidence) {
    return test.standard_error == 0 ? 0 : test.standard_error * student_quantile((1 + confidence) / 2, test.freedom);
}

}  // namespace diptych::core
