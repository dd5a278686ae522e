// The comparison of two means whose variances need not be equal.
#pragma once

#include <span>

namespace diptych::core {

/// What independent draws say. `variance` is the unbiased sample variance, 0 below two draws.
struct SampleSummary {
    double count = 0;
    double mean = 0;
    double variance = 0;
};

SampleSummary summarize(std::span<const double> values);

/// Welch 1947: t = (m1 - m2) / sqrt(s1²/n1 + s2²/n2), with the degrees of freedom of Welch and Satterthwaite.
struct WelchTest {
    double difference = 0;      // a - b
    double standard_error = 0;  // of the difference
    double freedom = 0;         // infinite where neither side varies
    double t = 0;
    double p = 1;  // two-sided
};

/// Each side has at least two draws. Where neither side varies, p is 1 for equal means, else 0.
WelchTest welch_test(const SampleSummary& a, const SampleSummary& b);
WelchTest welch_test(std::span<const double> a, std::span<const double> b);

/// Half the width of the confidence interval of the difference.
double confidence_half_width(const WelchTest& test, double confidence = 0.95);

}  // namespace diptych::core
