#include "stats/special_functions.h"

#include <cmath>
#include <limits>

namespace diptych::core {

namespace {

constexpr int most_terms = 100000;
constexpr double tiny = 1e-300;
constexpr double precision = 1e-16;

/// b0 + a1/(b1 + a2/(b2 + ...)) from the front (Lentz 1976, with the zero guard of Thompson and Barnett 1986). `term(n,
/// a, b)` gives a_n and b_n.
template <class Term>
double continued_fraction(double b0, const Term& term) {
    const auto guarded = [](double x) { return std::abs(x) < tiny ? tiny : x; };
    double value = guarded(b0);
    double c = value;
    double d = 0;
    for (int n = 1; n < most_terms; ++n) {
        double a = 0;
        double b = 0;
        term(n, a, b);
        d = 1 / guarded(b + a * d);
        c = guarded(b + a / c);
        value *= c * d;
        if (std::abs(c * d - 1) < precision) {
            break;
        }
    }
    return value;
}

/// x^a e^-x / Gamma(a)
double gamma_factor(double a, double x) {
    return std::exp(a * std::log(x) - x - std::lgamma(a));
}

double lower_series(double a, double x) {
    double term = 1 / a;
    double sum = term;
    for (int n = 1; n < most_terms && term > sum * precision; ++n) {
        term *= x / (a + n);
        sum += term;
    }
    return gamma_factor(a, x) * sum;
}

double upper_fraction(double a, double x) {
    const double denominator = continued_fraction(x + 1 - a, [&](int n, double& numerator, double& b) {
        numerator = n * (a - n);
        b = x + 1 - a + 2 * n;
    });
    return gamma_factor(a, x) / denominator;
}

double beta_fraction(double a, double b, double x, double one_minus_x) {
    const double front =
        std::exp(a * std::log(x) + b * std::log(one_minus_x) + std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b));
    const double denominator = continued_fraction(1, [&](int n, double& numerator, double& partial) {
        const double m = n / 2;  // whole
        numerator = n % 2 == 0 ? m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m))
                               : -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
        partial = 1;
    });
    return front / (a * denominator);
}

}  // namespace

double regularized_gamma_lower(double a, double x) {
    if (!(x > 0)) {
        return 0;
    }
    if (std::isinf(x)) {
        return 1;
    }
    return x < a + 1 ? lower_series(a, x) : 1 - upper_fraction(a, x);
}

double regularized_gamma_upper(double a, double x) {
    if (!(x > 0)) {
        return 1;
    }
    if (std::isinf(x)) {
        return 0;
    }
    return x < a + 1 ? 1 - lower_series(a, x) : upper_fraction(a, x);
}

double regularized_beta(double a, double b, double x) {
    return regularized_beta(a, b, x, 1 - x);
}

double regularized_beta(double a, double b, double x, double one_minus_x) {
    if (!(x > 0)) {
        return 0;
    }
    if (!(one_minus_x > 0)) {
        return 1;
    }
    return x < (a + 1) / (a + b + 2) ? beta_fraction(a, b, x, one_minus_x) : 1 - beta_fraction(b, a, one_minus_x, x);
}

}  // namespace diptych::core
