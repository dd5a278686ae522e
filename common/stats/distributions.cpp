#include "stats/distributions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "stats/special_functions.h"

namespace diptych::core {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// The zero of an increasing function between low and high, by halving: as good as a double gets.
template <class Function>
double find_zero(double low, double high, const Function& function) {
    for (int i = 0; i < 200; ++i) {
        const double middle = low + (high - low) / 2;
        if (middle <= low || middle >= high) {
            break;
        }
        (function(middle) < 0 ? low : high) = middle;
    }
    return low + (high - low) / 2;
}

}  // namespace

double normal_cdf(double z) {
    return std::erfc(-z / std::numbers::sqrt2) / 2;
}

double normal_upper(double z) {
    return std::erfc(z / std::numbers::sqrt2) / 2;
}

double normal_quantile(double p) {
    if (!(p > 0) || !(p < 1)) {
        return p == 0 ? -infinity : p == 1 ? infinity : nan;
    }
    // Newton on log(tail), which is nearly a parabola there: from the tail's asymptote a few steps do.
    const double tail = std::min(p, 1 - p);
    double z = std::sqrt(-2 * std::log(2 * tail));
    for (int i = 0; i < 50; ++i) {
        const double upper = normal_upper(z);
        const double density = std::exp(-z * z / 2) / std::sqrt(2 * std::numbers::pi);
        const double step = std::log(upper / tail) * upper / density;
        z += step;
        if (std::abs(step) <= 1e-15 * z) {
            break;
        }
    }
    return p < 0.5 ? -z : z;
}

double student_two_sided(double t, double freedom) {
    if (std::isnan(t) || !(freedom > 0)) {
        return nan;
    }
    if (std::isinf(t)) {
        return 0;
    }
    const double sum = freedom + t * t;
    return regularized_beta(freedom / 2, 0.5, freedom / sum, t * t / sum);
}

double student_cdf(double t, double freedom) {
    const double tail = student_two_sided(t, freedom) / 2;
    return t < 0 ? tail : 1 - tail;
}

double student_quantile(double p, double freedom) {
    if (!(p > 0) || !(p < 1)) {
        return p == 0 ? -infinity : p == 1 ? infinity : nan;
    }
    const double two_sided = 2 * std::min(p, 1 - p);
    double high = 1;
    while (student_two_sided(high, freedom) > two_sided && high < 1e300) {
        high *= 2;
    }
    const double t = find_zero(0, high, [&](double x) { return two_sided - student_two_sided(x, freedom); });
    return p < 0.5 ? -t : t;
}

double chi_square_upper(double x, double freedom) {
    return std::isnan(x) || !(freedom > 0) ? nan : regularized_gamma_upper(freedom / 2, x / 2);
}

double chi_square_quantile(double p, double freedom) {
    if (!(p > 0) || !(p < 1)) {
        return p == 0 ? 0 : p == 1 ? infinity : nan;
    }
    double high = freedom + 10;
    while (regularized_gamma_lower(freedom / 2, high / 2) < p && high < 1e300) {
        high *= 2;
    }
    return find_zero(0, high, [&](double x) { return regularized_gamma_lower(freedom / 2, x / 2) - p; });
}

double f_upper(double f, double numerator_freedom, double denominator_freedom) {
    if (std::isnan(f) || !(numerator_freedom > 0) || !(denominator_freedom > 0)) {
        return nan;
    }
    if (!(f > 0)) {
        return 1;
    }
    if (std::isinf(f)) {
        return 0;
    }
    const double scaled = numerator_freedom * f;
    const double sum = denominator_freedom + scaled;
    return regularized_beta(denominator_freedom / 2, numerator_freedom / 2, denominator_freedom / sum, scaled / sum);
}

}  // namespace diptych::core
