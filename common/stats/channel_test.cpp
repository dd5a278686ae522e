#include "stats/channel_test.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "stats/distributions.h"
#include "stats/symmetric_matrix.h"

namespace diptych::core {

namespace {

constexpr double equality_roundings = 8;
constexpr double p_beyond_doubt = 1e-9;

/// Sums of `rank` numbers and of their products, over the runs of one side.
struct Moments {
    std::array<double, 3> sum{};
    Matrix3 products{};  // upper triangle

    void add(const double* x, int rank) {
        for (int i = 0; i < rank; ++i) {
            const auto row = static_cast<std::size_t>(i);
            sum[row] += x[i];
            for (int j = i; j < rank; ++j) {
                products[row][static_cast<std::size_t>(j)] += x[i] * x[j];
            }
        }
    }
};

/// Covariance of the mean, `lost` degrees of freedom fewer than runs.
Matrix3 mean_covariance(const Moments& moments, std::size_t count, std::size_t rank, double lost = 1) {
    const double n = static_cast<double>(count);
    Matrix3 covariance{};
    rank = std::min<std::size_t>(rank, 3);  // it is never larger, which GCC 14 cannot see
    for (std::size_t i = 0; i < rank; ++i) {
        for (std::size_t j = i; j < rank; ++j) {
            const double value = (moments.products[i][j] - moments.sum[i] * moments.sum[j] / n) / (n - lost) / n;
            covariance[i][j] = value;
            covariance[j][i] = value;
        }
    }
    return covariance;
}

/// (tr(S M))² + tr((S M)²)
double trace_terms(const Matrix3& s, const Matrix3& m, std::size_t rank) {
    double product[3][3] = {};
    for (std::size_t i = 0; i < rank; ++i) {
        for (std::size_t j = 0; j < rank; ++j) {
            for (std::size_t k = 0; k < rank; ++k) {
                product[i][j] += s[i][k] * m[k][j];
            }
        }
    }
    double trace = 0;
    double trace_of_square = 0;
    for (std::size_t i = 0; i < rank; ++i) {
        trace += product[i][i];
        for (std::size_t j = 0; j < rank; ++j) {
            trace_of_square += product[i][j] * product[j][i];
        }
    }
    return trace * trace + trace_of_square;
}

double p_of_moments(const Moments& a, const Moments& b, std::size_t count_a, std::size_t count_b, std::size_t rank,
                    double lost) {
    const double n_a = static_cast<double>(count_a);
    const double n_b = static_cast<double>(count_b);
    const Matrix3 from_a = mean_covariance(a, count_a, rank, lost);
    const Matrix3 from_b = mean_covariance(b, count_b, rank, lost);
    Matrix3 covariance{};
    for (std::size_t i = 0; i < rank; ++i) {
        for (std::size_t j = 0; j < rank; ++j) {
            covariance[i][j] = from_a[i][j] + from_b[i][j];
        }
    }
    Matrix3 inverse{};
    if (!invert(covariance, static_cast<int>(rank), inverse)) {
        return 1;
    }
    double t_squared = 0;
    for (std::size_t i = 0; i < rank; ++i) {
        for (std::size_t j = 0; j < rank; ++j) {
            const double d_i = a.sum[i] / n_a - b.sum[i] / n_b;
            const double d_j = a.sum[j] / n_a - b.sum[j] / n_b;
            t_squared += d_i * inverse[i][j] * d_j;
        }
    }
    const double p = static_cast<double>(rank);
    const double freedom = (p + p * p) / (trace_terms(from_a, inverse, rank) / (n_a - lost) +
                                          trace_terms(from_b, inverse, rank) / (n_b - lost));
    const double rest = freedom - p + 1;
    return rest > 0 ? f_upper(t_squared * rest / (freedom * p), p, rest) : 1;
}

Channels mean_of(std::span<const Channels> runs) {
    Channels mean{};
    for (const Channels& run : runs) {
        for (std::size_t c = 0; c < 3; ++c) {
            mean[c] += run[c] / static_cast<double>(runs.size());
        }
    }
    return mean;
}

Matrix3 mean_covariance(std::span<const Channels> runs, const Channels& mean) {
    Moments moments;
    for (const Channels& run : runs) {
        const Channels centred = {run[0] - mean[0], run[1] - mean[1], run[2] - mean[2]};
        moments.add(centred.data(), 3);
    }
    return mean_covariance(moments, runs.size(), 3);
}

double dot(const std::array<double, 3>& a, const std::array<double, 3>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace

ChannelRuns channel_runs(std::span<const Channels> a, std::span<const Channels> b) {
    assert(a.size() >= 2 && b.size() >= 2);
    const Channels mean_a = mean_of(a);
    const Channels mean_b = mean_of(b);
    Matrix3 covariance = mean_covariance(a, mean_a);
    const Matrix3 from_b = mean_covariance(b, mean_b);
    Channels difference{};
    Channels center{};
    double scale = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        difference[c] = mean_a[c] - mean_b[c];
        center[c] = 0.5 * (mean_a[c] + mean_b[c]);
        scale = std::max({scale, std::abs(mean_a[c]), std::abs(mean_b[c])});
        for (std::size_t k = 0; k < 3; ++k) {
            covariance[c][k] += from_b[c][k];
        }
    }
    ChannelRuns runs;
    runs.count_a = a.size();
    runs.count_b = b.size();
    const double total = covariance[0][0] + covariance[1][1] + covariance[2][2] + dot(center, center);
    if (!std::isfinite(total)) {
        runs.state = ChannelState::unequal;
        return runs;
    }
    const Eigen3 eigen = symmetric_eigen(covariance);
    const double constant = channel_rounding * scale;
    const double fewest_freedom = static_cast<double>(std::min(a.size(), b.size())) - 1;
    // Few runs may show next to none of the noise that they have.
    const auto is_certain = [&](double apart, double error) {
        return !(error > 0) || student_two_sided(apart / error, fewest_freedom) < p_beyond_doubt;
    };
    std::vector<std::array<double, 3>> directions;
    for (std::size_t k = 0; k < 3; ++k) {
        const double error = std::sqrt(std::max(0.0, eigen.values[k]));
        const double apart = std::abs(dot(eigen.vectors[k], difference));
        const bool differs = apart > equality_roundings * constant;
        if (error > constant || (differs && !is_certain(apart, error))) {
            std::array<double, 3> direction = eigen.vectors[k];
            for (double& x : direction) {
                x /= error;
            }
            directions.push_back(direction);
        } else if (differs) {
            runs.state = ChannelState::unequal;
        }
    }
    runs.rank = static_cast<int>(directions.size());
    if (runs.state != ChannelState::unequal && runs.rank > 0) {
        runs.state = ChannelState::tested;
    }
    const auto project = [&](std::span<const Channels> side, const Channels& origin, std::vector<double>& target) {
        for (const Channels& run : side) {
            const Channels centred = {run[0] - origin[0], run[1] - origin[1], run[2] - origin[2]};
            for (const std::array<double, 3>& direction : directions) {
                target.push_back(dot(direction, centred));
            }
        }
    };
    project(a, center, runs.values);
    project(b, center, runs.values);
    project(a, mean_a, runs.deviations);
    project(b, mean_b, runs.deviations);
    return runs;
}

double channel_p(const ChannelRuns& runs) {
    if (runs.state != ChannelState::tested) {
        return runs.state == ChannelState::equal ? 1 : 0;
    }
    const auto rank = static_cast<std::size_t>(runs.rank);
    Moments sides[2];
    for (std::size_t i = 0; i < runs.count_a + runs.count_b; ++i) {
        sides[i < runs.count_a ? 0 : 1].add(&runs.values[i * rank], runs.rank);
    }
    return p_of_moments(sides[0], sides[1], runs.count_a, runs.count_b, rank, 1);
}

double resampled_channel_p(const ChannelRuns& runs, std::span<const double> sign) {
    assert(runs.state == ChannelState::tested && sign.size() == runs.count_a + runs.count_b);
    assert(runs.count_a >= 3 && runs.count_b >= 3);
    const auto rank = static_cast<std::size_t>(runs.rank);
    Moments sides[2];
    for (std::size_t i = 0; i < sign.size(); ++i) {
        double signed_deviation[3];
        for (std::size_t k = 0; k < rank; ++k) {
            signed_deviation[k] = sign[i] * runs.deviations[i * rank + k];
        }
        sides[i < runs.count_a ? 0 : 1].add(signed_deviation, runs.rank);
    }
    return p_of_moments(sides[0], sides[1], runs.count_a, runs.count_b, rank, 2);
}

}  // namespace diptych::core
