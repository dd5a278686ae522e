#include "stats/chi_square.h"

#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

#include "stats/distributions.h"

namespace diptych::core {

namespace {

constexpr double least_expected = 5;

struct Cell {
    double observed = 0;
    double expected = 0;
};

std::vector<Cell> pooled_cells(const std::vector<double>& observed, const std::vector<double>& expected) {
    std::vector<Cell> cells;
    Cell pool;
    std::size_t least = 0;
    for (std::size_t i = 0; i < observed.size(); ++i) {
        if (expected[i] < least_expected) {
            pool.observed += observed[i];
            pool.expected += expected[i];
            continue;
        }
        cells.push_back({observed[i], expected[i]});
        least = cells.back().expected < cells[least].expected ? cells.size() - 1 : least;
    }
    if (pool.expected >= least_expected || (cells.empty() && pool.expected > 0)) {
        cells.push_back(pool);
    } else if (!cells.empty()) {
        cells[least].observed += pool.observed;
        cells[least].expected += pool.expected;
    }
    return cells;
}

}  // namespace

ChiSquareFit chi_square_fit(const std::vector<double>& observed, const std::vector<double>& expected) {
    assert(observed.size() == expected.size());
    ChiSquareFit fit;
    for (std::size_t i = 0; i < observed.size(); ++i) {
        if (expected[i] == 0 && observed[i] > 0) {
            return {std::numeric_limits<double>::infinity(), 1, 0};
        }
    }
    const std::vector<Cell> cells = pooled_cells(observed, expected);
    if (cells.size() < 2) {
        return fit;
    }
    for (const Cell& cell : cells) {
        fit.statistic += (cell.observed - cell.expected) * (cell.observed - cell.expected) / cell.expected;
    }
    fit.freedom = static_cast<double>(cells.size() - 1);
    fit.p = chi_square_upper(fit.statistic, fit.freedom);
    return fit;
}

ChiSquareFit chi_square_uniform(const std::vector<double>& observed) {
    const double total = std::accumulate(observed.begin(), observed.end(), 0.0);
    return chi_square_fit(observed, std::vector<double>(observed.size(), total / static_cast<double>(observed.size())));
}

double chi_square_deviate(const ChiSquareFit& fit) {
    if (fit.freedom == 0) {
        return 0;
    }
    const double spread = 2 / (9 * fit.freedom);
    return (std::cbrt(fit.statistic / fit.freedom) - (1 - spread)) / std::sqrt(spread);
}

double chi_square_deviate(const std::vector<double>& observed, const std::vector<double>& expected) {
    return chi_square_deviate(chi_square_fit(observed, expected));
}

double uniform_deviate(const std::vector<double>& observed) {
    return chi_square_deviate(chi_square_uniform(observed));
}

}  // namespace diptych::core
