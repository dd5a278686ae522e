#include "stats/kolmogorov_smirnov.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace diptych::core {

namespace {

/// P(K > x) = 2 sum (-1)^(k-1) exp(-2 k² x²), by its theta-function twin where that series is slow.
double kolmogorov_upper(double x) {
    constexpr double pi = std::numbers::pi;
    if (x <= 0) {
        return 1;
    }
    if (x < 1) {
        double sum = 0;
        for (int k = 1; k <= 20; ++k) {
            const double odd = 2 * k - 1;
            sum += std::exp(-odd * odd * pi * pi / (8 * x * x));
        }
        return std::clamp(1 - std::sqrt(2 * pi) / x * sum, 0.0, 1.0);
    }
    double sum = 0;
    for (int k = 1; k <= 20; ++k) {
        sum += (k % 2 == 1 ? 2 : -2) * std::exp(-2.0 * k * k * x * x);
    }
    return std::clamp(sum, 0.0, 1.0);
}

}  // namespace

KolmogorovSmirnov kolmogorov_smirnov_uniform(std::vector<double> values) {
    KolmogorovSmirnov result;
    if (values.empty()) {
        return result;
    }
    std::sort(values.begin(), values.end());
    const double n = static_cast<double>(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double below = static_cast<double>(i) / n;
        result.distance = std::max({result.distance, values[i] - below, below + 1 / n - values[i]});
    }
    result.p = kolmogorov_upper((std::sqrt(n) + 0.12 + 0.11 / std::sqrt(n)) * result.distance);
    return result;
}

}  // namespace diptych::core
