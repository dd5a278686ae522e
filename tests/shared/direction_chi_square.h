// A chi-square test of drawn directions against the density that claims to describe them.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "close.h"
#include "compat.h"
#include "stats/chi_square.h"
#include "stats/multiple_testing.h"

namespace diptych::tests {

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
};

/// `draw(direction)` gives false for a null sample; `pdf(direction)` is per steradian. Null samples are a cell of their
/// own.
template <class Draw, class Pdf>
ChiSquareResult chi_square(const Chart& chart, int64_t draws, const Draw& draw, const Pdf& pdf) {
    constexpr int columns = 65;
    constexpr int rows = 130;
    // Where the horizon leaves a sliver of a cell, what its points miss of it grows with the draws, its noise with their root.
    const int fine = draws > 4000000 ? 64 : draws > 400000 ? 32 : draws > 150000 ? 16 : 8;
    std::vector<double> expected(columns * rows + 1, 0.0);
    std::vector<double> observed(columns * rows + 1, 0.0);
    ChiSquareResult result;
    // Jittered: the horizon is a jump of the density, and may run along the cells.
    Uniforms jitter(0x5eed);
    for (int i = 0; i < columns * fine; ++i) {
        for (int j = 0; j < rows * fine; ++j) {
            const vec2 u = jitter.next_pair();
            vec3 w;
            const double x = (i + static_cast<double>(u.x)) / (columns * fine);
            const double y = (j + static_cast<double>(u.y)) / (rows * fine);
            const double jacobian = chart.from_square(x, y, w);
            if (jacobian > 0.0) {
                expected[static_cast<size_t>((i / fine) * rows + j / fine)] +=
                    jacobian * static_cast<double>(pdf(w)) / (columns * fine) / (rows * fine);
            }
        }
    }
    for (const double e : expected) {
        result.pdf_integral += e;
    }
    expected.back() = std::max(0.0, 1.0 - result.pdf_integral);
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
    for (double& e : expected) {
        e = std::max(e * static_cast<double>(draws), 1e-9);  // pooled, not impossible: the density above says what is
    }
    result.p = chi_square_fit(observed, expected).p;
    return result;
}

/// The least p-value that passes one of `tests` tests at a family-wise error of 1e-3 (Šidák).
inline double sidak_threshold(int tests) {
    return diptych::sidak_threshold(1e-3, tests);
}

/// The unit direction with that cosine and azimuth.
inline vec3 direction_at(double cosine, double phi) {
    const double s = std::sqrt(1.0 - cosine * cosine);
    return vec3(static_cast<float>(s * std::cos(phi)), static_cast<float>(s * std::sin(phi)),
                static_cast<float>(cosine));
}

}  // namespace diptych::tests
