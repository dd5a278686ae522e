// Welch's test, its form in several channels, corrections for many tests, chi-square.
#include <cmath>
#include <random>

#include "catch.h"
#include "stats/channel_test.h"
#include "stats/chi_square.h"
#include "stats/distributions.h"
#include "stats/kolmogorov_smirnov.h"
#include "stats/multiple_testing.h"
#include "stats/symmetric_matrix.h"
#include "stats/welch.h"

using namespace diptych::core;

namespace {

const std::vector<double> first = {27.5, 21.0, 19.0, 23.6, 17.0, 17.9, 16.9, 20.1,
                                   21.9, 22.6, 23.1, 19.6, 19.0, 21.7, 21.4};
const std::vector<double> second = {27.1, 22.0, 20.8, 23.4, 23.4, 23.5, 25.8, 22.0,
                                    24.8, 20.2, 21.9, 22.1, 22.9, 30.5, 24.4};

std::vector<Channels> in_channels(const std::vector<double>& values, const Channels& factor) {
    std::vector<Channels> result;
    for (const double value : values) {
        result.push_back({factor[0] * value, factor[1] * value, factor[2] * value});
    }
    return result;
}

double p_of(const std::vector<Channels>& a, const std::vector<Channels>& b) {
    return channel_p(channel_runs(a, b));
}

const std::vector<Channels> colors_a = {{1.0, 2.0, 0.5}, {1.2, 2.1, 0.4}, {0.9, 1.8, 0.7},
                                        {1.1, 2.3, 0.5}, {1.3, 1.9, 0.6}, {0.8, 2.2, 0.55}};
const std::vector<Channels> colors_b = {
    {1.5, 2.0, 0.9}, {1.9, 2.6, 0.3}, {1.1, 1.7, 0.8}, {1.6, 2.9, 0.6}, {1.4, 2.2, 0.65}};

}  // namespace

TEST_CASE("Welch's test has the values of mpmath") {
    const WelchTest test = welch_test(first, second);
    CHECK(test.difference == Approx(-2.83333333333333).epsilon(1e-12));
    CHECK(test.standard_error == Approx(0.993122380923954).epsilon(1e-12));
    CHECK(test.t == Approx(-2.85295487017152).epsilon(1e-12));
    CHECK(test.freedom == Approx(27.8873039884201).epsilon(1e-12));
    CHECK(test.p == Approx(0.00807193817219487).epsilon(1e-11));
    CHECK(confidence_half_width(test) == Approx(2.03468940845863).epsilon(1e-11));
}

TEST_CASE("Without noise, Welch's test knows for sure") {
    const std::vector<double> ones = {1, 1, 1};
    const std::vector<double> twos = {2, 2, 2};
    CHECK(welch_test(ones, ones).p == 1);
    CHECK(welch_test(ones, twos).p == 0);
    CHECK(confidence_half_width(welch_test(ones, twos)) == 0);
    // One side without noise is a one-sample test.
    const WelchTest one_sided = welch_test(ones, first);
    CHECK(one_sided.freedom == Approx(14));
}

TEST_CASE("The test in three channels has the values of mpmath, whatever their units") {
    CHECK(p_of(colors_a, colors_b) == Approx(0.0475014057369832296260575741302).epsilon(1e-10));
    const auto mixed = [](const std::vector<Channels>& runs) {
        std::vector<Channels> result;
        for (const Channels& x : runs) {
            result.push_back({3 * x[0] + x[1], x[1] - x[2], 0.1 * x[2] + x[0] + 7});
        }
        return result;
    };
    CHECK(p_of(mixed(colors_a), mixed(colors_b)) == Approx(0.0475014057369832296260575741302).epsilon(1e-8));
    CHECK(p_of(colors_b, colors_a) == Approx(0.0475014057369832296260575741302).epsilon(1e-10));
}

TEST_CASE("In grey pictures, and in one-coloured ones, the test in channels is Welch's") {
    const double p = welch_test(first, second).p;
    for (const Channels& factor : {Channels{1, 1, 1}, Channels{0.3, 0.9, 0.01}, Channels{0, 2, 0}}) {
        const ChannelRuns runs = channel_runs(in_channels(first, factor), in_channels(second, factor));
        CHECK(runs.rank == 1);
        CHECK(channel_p(runs) == Approx(p).epsilon(1e-8));
    }
}

TEST_CASE("What does not vary is equal or not, but for rounding") {
    const std::vector<Channels> constant(4, Channels{1, 2, 3});
    const std::vector<Channels> rounded(4, Channels{1, 2.00001, 3});
    const std::vector<Channels> different(4, Channels{1, 2.001, 3});
    const std::vector<Channels> black(4, Channels{0, 0, 0});
    CHECK(channel_runs(constant, constant).state == ChannelState::equal);
    CHECK(channel_runs(constant, rounded).state == ChannelState::equal);
    CHECK(channel_runs(constant, different).state == ChannelState::unequal);
    CHECK(channel_runs(black, black).state == ChannelState::equal);
    CHECK(channel_runs(black, constant).state == ChannelState::unequal);
    CHECK(p_of(constant, different) == 0);
    CHECK(p_of(constant, constant) == 1);
    for (const double bad : {HUGE_VAL, std::nan("")}) {
        std::vector<Channels> broken = in_channels(first, {1, 1, 1});
        broken[3][1] = bad;
        CHECK(channel_runs(broken, broken).state == ChannelState::unequal);
    }
    // Red varies alike, blue is constant and differs.
    std::vector<Channels> a = in_channels(first, {1, 0, 0});
    std::vector<Channels> b = a;
    for (std::size_t i = 0; i < a.size(); ++i) {
        a[i][2] = 10;
        b[i][2] = 10.1;
    }
    CHECK(channel_runs(a, b).state == ChannelState::unequal);
}

TEST_CASE("Few runs that by chance vary little in one direction are not taken for constant ones") {
    std::mt19937_64 random(5);
    std::normal_distribution<double> normal;
    int unequal = 0;
    int rejected = 0;
    constexpr int draws = 20000;
    for (int i = 0; i < draws; ++i) {
        std::vector<Channels> sides[2];
        for (std::vector<Channels>& side : sides) {
            for (int run = 0; run < 3; ++run) {
                side.push_back({1 + 0.1 * normal(random), 1 + 0.1 * normal(random), 1 + 5e-5 * normal(random)});
            }
        }
        const ChannelRuns runs = channel_runs(sides[0], sides[1]);
        unequal += runs.state == ChannelState::unequal ? 1 : 0;
        rejected += channel_p(runs) < 1e-3 ? 1 : 0;
    }
    CHECK(unequal == 0);
    CHECK(rejected < 40);  // of 20 expected, at most
}

TEST_CASE("Draws without a difference have uniform p-values, whatever the sides' noise") {
    std::mt19937_64 random(3);
    std::normal_distribution<double> normal;
    std::vector<double> p;
    for (int i = 0; i < 4000; ++i) {
        std::vector<Channels> a;
        std::vector<Channels> b;
        for (int run = 0; run < 8; ++run) {
            a.push_back({9 + normal(random), normal(random), 2 * normal(random)});
            b.push_back({5 * normal(random), normal(random), normal(random)});
        }
        std::vector<double> sign = {1, -1, 1, -1, 1, -1, 1, -1, 1, 1, -1, -1, 1, 1, -1, -1};
        p.push_back(resampled_channel_p(channel_runs(a, b), sign));
    }
    CHECK(kolmogorov_smirnov_uniform(p).distance < 0.03);  // eight runs: the degrees of freedom are approximate
}

TEST_CASE("Eigenvectors and inverses of symmetric matrices undo them") {
    const Matrix3 m{{{4, 1, -2}, {1, 3, 0.5}, {-2, 0.5, 5}}};
    const Eigen3 eigen = symmetric_eigen(m);
    Matrix3 inverse{};
    REQUIRE(invert(m, 3, inverse));
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            double rebuilt = 0;
            double identity = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                rebuilt += eigen.values[k] * eigen.vectors[k][i] * eigen.vectors[k][j];
                identity += m[i][k] * inverse[k][j];
            }
            CHECK(rebuilt == Approx(m[i][j]).margin(1e-13));
            CHECK(identity == Approx(i == j ? 1 : 0).margin(1e-13));
        }
    }
    for (const std::size_t rank : {1U, 2U}) {  // of the block in front
        REQUIRE(invert(m, static_cast<int>(rank), inverse));
        for (std::size_t i = 0; i < rank; ++i) {
            for (std::size_t j = 0; j < rank; ++j) {
                const double identity = m[i][0] * inverse[0][j] + (rank > 1 ? m[i][1] * inverse[1][j] : 0);
                CHECK(identity == Approx(i == j ? 1 : 0).margin(1e-13));
            }
        }
    }
    CHECK_FALSE(invert({{{1, 1, 0}, {1, 1, 0}, {0, 0, 1}}}, 2, inverse));
}

TEST_CASE("Many p-values are combined and corrected as the papers say") {
    const std::vector<double> p = {0.01, 0.2, 0.7, 0.04};
    CHECK(fisher_statistic(p) == Approx(19.58031773445825));
    CHECK(fisher_combined(p) == Approx(0.0120459920405177).epsilon(1e-12));
    CHECK(fisher_combined({}) == 1);
    CHECK(merged_p(std::vector<double>{1e-4, 1e-2}) == Approx(std::exp(1.0) * 1e-3));
    CHECK(merged_p(std::vector<double>{0.5, 0.5}) == 1);
    CHECK(merged_p({}) == 1);
    CHECK(std::isfinite(fisher_statistic(std::vector<double>{0.0, 0.5})));
    // With the moments of independent p-values, the scaled chi-square is Fisher's own.
    CHECK(scaled_chi_square_upper(19.58031773445825, 8, 16) == Approx(0.0120459920405177).epsilon(1e-12));
    // Four identical p-values: the sum is four times one -2 ln p, of variance 64; p is that of one.
    CHECK(scaled_chi_square_upper(4 * 7.377758908227872, 8, 64) == Approx(0.025));
    const std::vector<double> adjusted = holm_adjusted(p);
    CHECK(adjusted[0] == Approx(0.04));
    CHECK(adjusted[3] == Approx(0.12));
    CHECK(adjusted[1] == Approx(0.4));
    CHECK(adjusted[2] == Approx(0.7));
    CHECK(holm_adjusted(std::vector<double>{0.03, 0.02})[0] == Approx(0.04));  // never below a smaller one's
    CHECK(sidak_adjusted(1e-9, 1000) == Approx(9.999995005e-7));
    CHECK(sidak_adjusted(1, 5) == 1);
    CHECK(sidak_adjusted(sidak_threshold(1e-3, 77), 77) == Approx(1e-3));
}

TEST_CASE("Chi-square pools what expects too little and sees what cannot be") {
    const ChiSquareFit fit = chi_square_fit({18, 22, 31, 29}, {25, 25, 25, 25});
    CHECK(fit.statistic == Approx((49 + 9 + 36 + 16) / 25.0));
    CHECK(fit.freedom == 3);
    CHECK(fit.p == Approx(chi_square_upper(4.4, 3)));
    // Cells of 2 and 4 make one of 6; a lone cell of 2 joins the least of the others.
    const ChiSquareFit pooled = chi_square_fit({10, 3, 5}, {12, 2, 4});
    CHECK(pooled.freedom == 1);
    CHECK(pooled.statistic == Approx(4.0 / 12 + 4.0 / 6));
    const ChiSquareFit joined = chi_square_fit({10, 20, 3}, {12, 19, 2});
    CHECK(joined.freedom == 1);
    CHECK(joined.statistic == Approx(1.0 / 14 + 1.0 / 19));
    CHECK(chi_square_fit({10, 1}, {10, 0}).p == 0);
    CHECK(std::isinf(chi_square_deviate({10, 1}, {10, 0})));
    CHECK(chi_square_fit({3}, {3}).p == 1);
    // Wilson and Hilferty's deviate is the normal one of the same p.
    CHECK(normal_upper(chi_square_deviate(fit)) == Approx(fit.p).epsilon(0.01));
    CHECK(chi_square_uniform({18, 22, 31, 29}).statistic == Approx(fit.statistic));
}
