#include "stats/multiple_testing.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "stats/distributions.h"

namespace diptych::core {

double fisher_statistic(std::span<const double> p) {
    double sum = 0;
    for (const double value : p) {
        sum -= 2 * std::log(std::max(value, 1e-300));
    }
    return sum;
}

double fisher_combined(std::span<const double> p) {
    return p.empty() ? 1 : chi_square_upper(fisher_statistic(p), 2 * static_cast<double>(p.size()));
}

double merged_p(std::span<const double> p) {
    return p.empty() ? 1 : std::min(1.0, std::exp(1 - fisher_statistic(p) / (2 * static_cast<double>(p.size()))));
}

double scaled_chi_square_upper(double statistic, double mean, double variance) {
    if (!(mean > 0) || !(variance > 0)) {
        return statistic <= mean ? 1 : 0;
    }
    return chi_square_upper(2 * mean * statistic / variance, 2 * mean * mean / variance);
}

std::vector<double> holm_adjusted(std::span<const double> p) {
    std::vector<std::size_t> order(p.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return p[i] < p[j]; });
    std::vector<double> adjusted(p.size());
    double largest = 0;
    for (std::size_t rank = 0; rank < order.size(); ++rank) {
        largest = std::max(largest, std::min(1.0, static_cast<double>(p.size() - rank) * p[order[rank]]));
        adjusted[order[rank]] = largest;
    }
    return adjusted;
}

double sidak_adjusted(double least_p, double n) {
    return least_p >= 1 ? 1 : -std::expm1(n * std::log1p(-least_p));
}

double sidak_threshold(double alpha, double n) {
    return -std::expm1(std::log1p(-alpha) / n);
}

}  // namespace diptych::core
