// A chi-square test of drawn directions against the density that claims to describe them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "close.h"
#include "language/compat.h"
#include "stats/chi_square.h"
#include "stats/multiple_testing.h"

namespace diptych::core::tests {

using shared::vec2;
using shared::vec3;

/// Random numbers as the renderer's: multiples of 2^-24 in [0, 1).
class Uniforms {
public:
    explicit Uniforms(uint32_t seed) : engine_(seed) {}
    float next() { return static_cast<float>(engine_() >> 8U) * 0x1p-24f; }
    vec2 next_pair() {
        const float x = next();
        const float y = next();
        return vec2(x, y);
    }

private:
    std::mt19937 engine_;
};

/// A chart of directions: the unit square's point of a direction, and back with the density's factor.
struct Chart {
    std::function<bool(vec3, double&, double&)> to_square;
    /// The direction at (x, y), and d(solid angle) / d(x, y); 0 where the point stands for no direction.
    std::function<double(double, double, vec3&)> from_square;
};

/// The upper hemisphere by (sqrt(cos), phi), finer toward the horizon.
inline Chart hemisphere_chart() {
    Chart chart;
    chart.to_square = [](vec3 w, double& x, double& y) {
        x = std::sqrt(std::max(0.0, static_cast<double>(w.z)));
        y = 0.5 + std::atan2(static_cast<double>(w.y), static_cast<double>(w.x)) / (2.0 * M_PI);
        return w.z > 0.0f;
    };
    chart.from_square = [](double x, double y, vec3& w) {
        const double z = x * x;
        const double s = std::sqrt(1.0 - z * z);
        const double phi = 2.0 * M_PI * (y - 0.5);
        w = vec3(static_cast<float>(s * std::cos(phi)), static_cast<float>(s * std::sin(phi)), static_cast<float>(z));
        return 4.0 * M_PI * x;
    };
    return chart;
}

/// The facet normal at (x, y), with tan = alpha sqrt(1/(1 - x)^2 - 1) and phi by y; returns d(solid angle) / d(x, y).
inline double facet_at(double alpha, double x, double y, double (&h)[3]) {
    const double v = 1.0 - x;
    const double tan2 = alpha * alpha * (1.0 / (v * v) - 1.0);
    const double c = 1.0 / std::sqrt(1.0 + tan2);
    const double s = std::sqrt(tan2) * c;
    const double phi = 2.0 * M_PI * (y - 0.5);
    h[0] = s * std::cos(phi);
    h[1] = s * std::sin(phi);
    h[2] = c;
    return 2.0 * M_PI * c * c * c * alpha * alpha / (v * v * v);
}

/// The integral of a function of facet normals over their hemisphere, by the midpoint rule on n x 2n points.
template <class Function>
double integrate_facets(double alpha, int n, const Function& function) {
    double sum = 0.0;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < 2 * n; ++j) {
            double h[3];
            const double jacobian = facet_at(alpha, (i + 0.5) / n, (j + 0.5) / (2.0 * n), h);
            sum +=
                jacobian * function(vec3(static_cast<float>(h[0]), static_cast<float>(h[1]), static_cast<float>(h[2])));
        }
    }
    return sum / (2.0 * n * n);
}

/// wi by its half vector with wo: x = 1 - 1/sqrt(1 + tan^2/alpha^2), which spreads a lobe of width alpha; y = phi.
inline Chart half_vector_chart(vec3 wo, double alpha) {
    Chart chart;
    chart.to_square = [wo, alpha](vec3 wi, double& x, double& y) {
        const double hx = static_cast<double>(wo.x) + static_cast<double>(wi.x);
        const double hy = static_cast<double>(wo.y) + static_cast<double>(wi.y);
        const double hz = static_cast<double>(wo.z) + static_cast<double>(wi.z);
        x = 1.0 - 1.0 / std::sqrt(1.0 + (hx * hx + hy * hy) / (hz * hz * alpha * alpha));
        y = 0.5 + std::atan2(hy, hx) / (2.0 * M_PI);
        return wi.z > 0.0f;
    };
    chart.from_square = [wo, alpha](double x, double y, vec3& wi) {
        double h[3];
        const double facet_jacobian = facet_at(alpha, x, y, h);
        const double o_dot_h =
            h[0] * static_cast<double>(wo.x) + h[1] * static_cast<double>(wo.y) + h[2] * static_cast<double>(wo.z);
        wi = vec3(static_cast<float>(2.0 * o_dot_h * h[0] - static_cast<double>(wo.x)),
                  static_cast<float>(2.0 * o_dot_h * h[1] - static_cast<double>(wo.y)),
                  static_cast<float>(2.0 * o_dot_h * h[2] - static_cast<double>(wo.z)));
        return o_dot_h > 0.0 && wi.z > 0.0f ? facet_jacobian * 4.0 * o_dot_h : 0.0;
    };
    return chart;
}

/// The integral of a function of directions over a chart, by the midpoint rule on n x 2n points.
template <class Function>
double integrate(const Chart& chart, int n, const Function& function) {
    double sum = 0.0;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < 2 * n; ++j) {
            vec3 w;
            const double jacobian = chart.from_square((i + 0.5) / n, (j + 0.5) / (2.0 * n), w);
            sum += jacobian > 0.0 ? jacobian * function(w) : 0.0;
        }
    }
    return sum / (2.0 * n * n);
}

struct ChiSquareResult {
    double p = 0.0;
    double null_fraction = 0.0;  ///< Of the draws.
    double pdf_integral = 0.0;
    int64_t impossible = 0;  ///< Draws where the density is zero, negative or not finite.
    /// What the quadrature's own error adds to the statistic, in that statistic's standard deviations.
    double quadrature = 0.0;
};

/// Above this, the expected counts rather than the draws could decide.
constexpr double quadrature_limit = 0.1;

/// The integral of a density over the chart's cell [x, x + width] x [y, y + height], by one jittered point in each of
/// n x n strata, which is without bias; and the share of the points where there is any.
struct CellIntegral {
    double value = 0.0;
    double share = 0.0;
};

template <class Pdf>
CellIntegral integrate_cell(const Chart& chart, double x, double y, double width, double height, int n,
                            Uniforms& jitter, const Pdf& pdf) {
    CellIntegral result;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const vec2 u = jitter.next_pair();
            vec3 w;
            const double jacobian = chart.from_square(x + width * (i + static_cast<double>(u.x)) / n,
                                                      y + height * (j + static_cast<double>(u.y)) / n, w);
            const double value = jacobian > 0.0 ? jacobian * static_cast<double>(pdf(w)) : 0.0;
            result.value += value;
            result.share += value > 0.0 ? 1.0 : 0.0;
        }
    }
    result.value *= width * height / (n * n);
    result.share /= n * n;
    return result;
}

/// The integral over each of columns x rows cells, by fine x fine points in one. The horizon, where the density jumps,
/// cuts slivers off cells: there, and in cells beside (the rows close a circle), it takes four times as many a side.
template <class Pdf>
std::vector<double> integrate_cells(const Chart& chart, int columns, int rows, int fine, const Pdf& pdf,
                                    std::uint32_t seed) {
    Uniforms jitter(seed);
    std::vector<CellIntegral> cells(static_cast<size_t>(columns * rows));
    const auto over = [&](int i, int j, int n) {
        return integrate_cell(chart, static_cast<double>(i) / columns, static_cast<double>(j) / rows, 1.0 / columns,
                              1.0 / rows, n, jitter, pdf);
    };
    const auto index = [&](int i, int j) { return static_cast<size_t>(i * rows + (j + rows) % rows); };
    for (int i = 0; i < columns; ++i) {
        for (int j = 0; j < rows; ++j) {
            cells[index(i, j)] = over(i, j, fine);
        }
    }
    std::vector<double> values(cells.size());
    for (int i = 0; i < columns; ++i) {
        for (int j = 0; j < rows; ++j) {
            double least = 1.0;
            double most = 0.0;
            for (int k = 0; k < 9; ++k) {
                const double share = cells[index(std::clamp(i + k / 3 - 1, 0, columns - 1), j + k % 3 - 1)].share;
                least = std::min(least, share);
                most = std::max(most, share);
            }
            values[index(i, j)] = least < 1.0 && most > 0.0 ? over(i, j, 4 * fine).value : cells[index(i, j)].value;
        }
    }
    return values;
}

/// `draw(direction)` gives false for a null sample; `pdf(direction)` is per steradian. Null samples are a cell of their
/// own.
template <class Draw, class Pdf>
ChiSquareResult chi_square(const Chart& chart, int64_t draws, const Draw& draw, const Pdf& pdf) {
    constexpr int columns = 65;
    constexpr int rows = 130;
    const int fine = draws > 4000000 ? 48 : draws > 400000 ? 16 : draws > 131072 ? 8 : 5;  // see quadrature_limit
    std::vector<double> expected(columns * rows + 1, 0.0);
    std::vector<double> observed(columns * rows + 1, 0.0);
    ChiSquareResult result;
    const std::vector<double> sums[2] = {integrate_cells(chart, columns, rows, fine, pdf, 0x5eed),
                                         integrate_cells(chart, columns, rows, fine, pdf, 0x5eee)};
    double error = 0.0;
    for (size_t cell = 0; cell < sums[0].size(); ++cell) {
        const double mean = 0.5 * (sums[0][cell] + sums[1][cell]);
        const double apart = 0.5 * (sums[0][cell] - sums[1][cell]);
        expected[cell] = mean;
        result.pdf_integral += mean;
        error += apart * apart / std::max(mean, 5.0 / static_cast<double>(draws));
    }
    for (int64_t k = 0; k < draws; ++k) {
        vec3 w;
        if (!draw(w)) {
            observed.back() += 1.0;
            continue;
        }
        const float density = pdf(w);
        double x = 0.0;
        double y = 0.0;
        if (!(density > 0.0f && density < 1e30f) || !chart.to_square(w, x, y)) {
            ++result.impossible;
            continue;
        }
        const int i = std::min(static_cast<int>(x * columns), columns - 1);
        const int j = std::min(static_cast<int>(y * rows), rows - 1);
        observed[static_cast<size_t>(i * rows + j)] += 1.0;
    }
    result.null_fraction = observed.back() / static_cast<double>(draws);
    expected.back() = std::max(0.0, 1.0 - result.pdf_integral);
    for (double& e : expected) {
        e = std::max(e * static_cast<double>(draws), 1e-9);  // pooled, not impossible: the density above says what is
    }
    const ChiSquareFit fit = chi_square_fit(observed, expected);
    result.p = fit.p;
    result.quadrature = error * static_cast<double>(draws) / std::sqrt(2.0 * std::max(fit.freedom, 1.0));
    return result;
}

/// The least p-value that passes one of `tests` tests at a family-wise error of 1e-3 (Šidák).
inline double sidak_threshold(int tests) {
    return diptych::core::sidak_threshold(1e-3, tests);
}

/// The unit direction with that cosine and azimuth.
inline vec3 direction_at(double cosine, double phi) {
    const double s = std::sqrt(1.0 - cosine * cosine);
    return vec3(static_cast<float>(s * std::cos(phi)), static_cast<float>(s * std::sin(phi)),
                static_cast<float>(cosine));
}

}  // namespace diptych::core::tests
