#include "catch.h"

#include <cmath>
#include <random>

#include "stats/bias_squared.h"
#include "stats/convergence.h"

using namespace diptych::core;

namespace {

const std::vector<double> powers = {1, 2, 4, 8, 16, 32, 64, 128};

/// MSE over 300 pixels of `runs` progressive renders: pixels of standard deviation 1 a sample and one bias.
ErrorTable made_up_errors(int runs, double bias, std::mt19937_64& random, double exponent = -1) {
    std::normal_distribution<double> normal;
    ErrorTable errors;
    for (int run = 0; run < runs; ++run) {
        std::vector<double> curve;
        std::vector<double> sums(300, 0);
        double done = 0;
        for (const double n : powers) {
            double mse = 0;
            for (double& sum : sums) {
                sum += normal(random) * std::sqrt(n - done);
                const double noise = sum / n * std::pow(n, (exponent + 1) / 2);
                mse += (noise + bias) * (noise + bias) / 300;
            }
            done = n;
            curve.push_back(mse);
        }
        errors.push_back(curve);
    }
    return errors;
}

DeviationSums made_up_sums(int runs, std::size_t values, double bias, double reference_noise, std::mt19937_64& random,
                           std::vector<float>& variance) {
    std::normal_distribution<float> normal;
    std::vector<float> reference(values);
    for (float& value : reference) {
        value = static_cast<float>(reference_noise) * normal(random);
    }
    variance.assign(values, static_cast<float>(reference_noise * reference_noise));
    DeviationSums sums;
    for (int run = 0; run < runs; ++run) {
        std::vector<float> deviations(values);
        for (std::size_t i = 0; i < values; ++i) {
            deviations[i] = static_cast<float>(bias) + normal(random) - reference[i];
        }
        sums.add(deviations);
    }
    return sums;
}

}  // namespace

TEST_CASE("a mean's interval covers the truth as often as it says", "[stats]") {
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal(3, 2);
    int covered = 0;
    for (int i = 0; i < 4000; ++i) {
        std::vector<double> values(8);
        for (double& value : values) {
            value = normal(random);
        }
        const Interval interval = mean_interval(values);
        covered += interval.low <= 3 && 3 <= interval.high ? 1 : 0;
    }
    CHECK(covered / 4000.0 == Approx(0.95).margin(0.012));  // 3.5 standard errors
    CHECK(std::isnan(mean_interval(std::vector<double>{}).value));
    CHECK(mean_interval(std::vector<double>{2}).value == 2);
    CHECK(std::isnan(mean_interval(std::vector<double>{2}).low));
    CHECK(median({3, 1, 2}) == 2);
    CHECK(median({4, 1, 2, 3}) == 2.5);
}

TEST_CASE("the slope of a known decline is found, and its interval covers it", "[stats]") {
    const double exponent = GENERATE(-1.0, -1.5);
    std::mt19937_64 random(2);
    const std::vector<bool> all(powers.size(), true);
    int covered = 0;
    double mean = 0;
    for (int i = 0; i < 300; ++i) {
        const Interval slope = log_slope(powers, made_up_errors(16, 0, random, exponent), all);
        mean += slope.value / 300;
        covered += slope.low <= exponent && exponent <= slope.high ? 1 : 0;
    }
    CHECK(mean == Approx(exponent).margin(0.002));
    CHECK(covered / 300.0 == Approx(0.95).margin(0.045));
    // A floor that is not left out bends it.
    const ErrorTable biased = made_up_errors(16, 0.5, random);
    CHECK(log_slope(powers, biased, all).value > -0.8);
    std::vector<bool> few(powers.size(), false);
    few[0] = few[1] = true;
    CHECK(std::isnan(log_slope(powers, biased, few).value));
}

TEST_CASE("the slope leaves out what is not above zero", "[stats]") {
    const ErrorTable errors = {{1, 0.5, 0.25, -0.1}, {1, 0.5, 0.25, 0.2}};
    const Interval slope = log_slope(std::vector<double>{1, 2, 4, 8}, errors, {true, true, true, true});
    CHECK(slope.value == Approx(-1));
    CHECK(slope.low == Approx(-1));
}

TEST_CASE("b squared is found where there is a bias, and as rarely as said where there is none", "[stats]") {
    std::mt19937_64 random(3);
    int alarms = 0;
    double mean = 0;
    for (int i = 0; i < 500; ++i) {
        const BiasFit fit = fit_bias(powers, made_up_errors(16, 0, random));
        alarms += fit.p < 0.05 ? 1 : 0;
        mean += fit.bias_squared.value / 500;
    }
    CHECK(alarms / 500.0 == Approx(0.05).margin(0.035));
    CHECK(std::abs(mean) < 1e-4);  // noise / N is 1 .. 0.008
    int covered = 0;
    mean = 0;
    for (int i = 0; i < 200; ++i) {
        const BiasFit fit = fit_bias(powers, made_up_errors(16, 0.1, random));
        mean += fit.bias_squared.value / 200;
        covered += fit.bias_squared.low < 0.01 && fit.bias_squared.high > 0.01 ? 1 : 0;
        REQUIRE(fit.noise == Approx(1).epsilon(0.1));
        REQUIRE(fit.p < 1e-4);
    }
    CHECK(mean == Approx(0.01).epsilon(0.01));
    CHECK(covered / 200.0 == Approx(0.95).margin(0.055));
    // What all runs share may not pass for bias.
    CHECK(fit_bias(powers, made_up_errors(16, 0.1, random), 0.01).p > 0.05);
    CHECK(std::isnan(fit_bias(powers, {}, 0).p));
    const BiasFit exact = fit_bias(std::vector<double>{1, 2, 4}, {{3, 2, 1.5}, {3, 2, 1.5}});
    CHECK(exact.bias_squared.value == Approx(1));
    CHECK(exact.noise == Approx(2));
}

TEST_CASE("the squared bias of renders is estimated without bias", "[stats]") {
    std::mt19937_64 random(4);
    std::vector<float> variance;
    const double bias = GENERATE(0.0, 0.2), reference_noise = GENERATE(0.0, 0.3);
    double mean = 0, squares = 0;
    int alarms = 0;
    const int trials = 400;
    double said = 0, heavy = 0;
    for (int i = 0; i < trials; ++i) {
        const DeviationSums sums = made_up_sums(16, 3 * 20 * 20, bias, reference_noise, random, variance);
        const BiasSquared result = bias_squared(sums, variance, {}, 20, 3, 1);
        mean += result.value / trials;
        squares += result.value * result.value / trials;
        said += result.standard_error / trials;
        alarms += result.p < 0.05 ? 1 : 0;
        heavy += result.heavy / trials;
    }
    const double spread = std::sqrt(squares - mean * mean);
    INFO("bias " << bias << ", reference " << reference_noise);
    CHECK(mean == Approx(bias * bias).margin(4 * spread / std::sqrt(trials)));
    CHECK(said == Approx(spread).epsilon(0.15));
    if (bias == 0) {
        CHECK(alarms / double(trials) == Approx(0.05).margin(0.04));
        CHECK(heavy < 0.03);
    } else {
        CHECK(alarms == trials);
    }
}

TEST_CASE("a reference taken for exact makes its noise a bias", "[stats]") {
    std::mt19937_64 random(5);
    std::vector<float> variance;
    const DeviationSums sums = made_up_sums(16, 3 * 32 * 32, 0, 0.3, random, variance);
    CHECK(bias_squared(sums, variance, {}, 32, 3, 4).p > 0.001);
    const std::vector<float> noiseless(variance.size(), 0.0F);
    const BiasSquared wrong = bias_squared(sums, noiseless, {}, 32, 3, 4);
    CHECK(wrong.value == Approx(0.09).epsilon(0.1));
    CHECK(wrong.p < 1e-6);
}

TEST_CASE("weights keep the noise of a few values from hiding the bias of the rest", "[stats]") {
    std::mt19937_64 random(8);
    std::normal_distribution<float> normal;
    DeviationSums sums;
    std::vector<float> weights(1024, 1.0F), exact(1024, 0.0F);
    for (int run = 0; run < 16; ++run) {
        std::vector<float> deviations(1024);
        for (std::size_t i = 0; i < deviations.size(); ++i) {
            const bool bright = i % 64 == 0;
            deviations[i] = bright ? 100 * normal(random) : 0.3F + normal(random);
            weights[i] = bright ? 1e-4F : 1.0F;
        }
        sums.add(deviations);
    }
    CHECK(bias_squared(sums, exact, {}, 32, 1, 1).p > 1e-3);
    const BiasSquared weighted = bias_squared(sums, exact, weights, 32, 1, 1);
    CHECK(weighted.p < 1e-6);
    CHECK(weighted.value == Approx(0.09).epsilon(0.2));
}

TEST_CASE("neighbours that share their noise want blocks", "[stats]") {
    // Each 8 x 8 pixels have one noise: pixel by pixel, that looks like 64 times as many observations.
    std::mt19937_64 random(6);
    std::normal_distribution<float> normal;
    const std::size_t side = 64;
    const std::vector<float> exact(side * side, 0.0F);
    int by_pixel = 0, by_block = 0;
    for (int i = 0; i < 300; ++i) {
        DeviationSums sums;
        for (int run = 0; run < 8; ++run) {
            std::vector<float> blocks(64), deviations(side * side);
            for (float& value : blocks) {
                value = normal(random);
            }
            for (std::size_t k = 0; k < deviations.size(); ++k) {
                deviations[k] = blocks[k / side / 8 * 8 + k % side / 8];
            }
            sums.add(deviations);
        }
        by_pixel += bias_squared(sums, exact, {}, int(side), 1, 1).p < 0.05 ? 1 : 0;
        by_block += bias_squared(sums, exact, {}, int(side), 1, 8).p < 0.05 ? 1 : 0;
    }
    CHECK(by_block / 300.0 < 0.11);
    CHECK(by_pixel / 300.0 > 0.2);
}

TEST_CASE("rare bright samples are told by their weight in one run", "[stats]") {
    std::mt19937_64 random(7);
    std::bernoulli_distribution rare(0.02);
    DeviationSums sums;
    for (int run = 0; run < 16; ++run) {
        std::vector<float> deviations(3 * 256);
        for (float& value : deviations) {
            value = rare(random) ? 49.0F : -1.0F;  // of mean 0
        }
        sums.add(deviations);
    }
    CHECK(bias_squared(sums, std::vector<float>(3 * 256, 0.0F), {}, 16, 3, 1).heavy > 0.2);
    CHECK(std::isnan(bias_squared(sums, std::vector<float>(3 * 256, 0.0F), {}, 16, 3, 16).p));  // one block
    CHECK(std::isnan(bias_squared(DeviationSums{}, {}, {}, 16, 3, 1).value));
}

TEST_CASE("times and errors lie on lines between the measurements", "[stats]") {
    const std::vector<double> seconds = {1, 2, 4, 8}, errors = {1, 0.5, 0.25, 0.125};
    const TargetTime reached = time_to_target(seconds, errors, 0.4);
    CHECK(reached.kind == TargetTime::Kind::reached);
    CHECK(reached.seconds == Approx(2.5));
    CHECK(time_to_target(seconds, errors, 2).kind == TargetTime::Kind::earlier);
    CHECK(time_to_target(seconds, errors, 2).seconds == 1);
    CHECK(time_to_target(seconds, errors, 0.1).kind == TargetTime::Kind::later);
    CHECK(time_to_target(seconds, errors, 0.1).seconds == 8);
    CHECK(time_to_target({}, {}, 0.1).kind == TargetTime::Kind::unknown);
}
