// The alias table against the probabilities that it was built from.
#include <cmath>
#include <random>

#include "numbers/alias_table.h"
#include "catch.h"
#include "pack/alias_table_build.h"

using namespace diptych::core;

namespace {

/// What the table picks, exactly: columns are alike, and alias_pick compares 32 bits with a threshold of its own.
std::vector<double> table_probabilities(const std::vector<shared::AliasEntry>& table) {
    std::vector<double> out(table.size(), 0.0);
    for (std::size_t i = 0; i < table.size(); ++i) {
        const double threshold = std::floor(std::max(table[i].probability, 0.0F) * 4294967296.0);
        const double kept = table[i].probability >= 1 ? 1 : threshold / 4294967296.0;
        out[i] += kept / static_cast<double>(table.size());
        out.at(table[i].alias) += (1 - kept) / static_cast<double>(table.size());
    }
    return out;
}

std::vector<double> decades(std::size_t n, double count, std::uint32_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> exponent(-count / 2, count / 2);
    std::vector<double> weights(n);
    for (double& w : weights) {
        w = std::pow(10.0, exponent(random));
    }
    return weights;
}

}  // namespace

TEST_CASE("The alias table holds its probabilities over twelve decades") {
    for (const std::size_t n : {1, 2, 3, 7, 100, 4096, 100000}) {
        for (const double defensive : {0.0, 0.05}) {
            const std::vector<double> p = pick_probabilities(decades(n, 12, static_cast<std::uint32_t>(n)), defensive);
            const std::vector<double> q = table_probabilities(build_alias_table(p));
            double sum = 0;
            double worst = 0;      // against the mean probability
            double worst_big = 0;  // relative, of what is picked more often than the mean
            for (std::size_t i = 0; i < n; ++i) {
                sum += p[i];
                worst = std::max(worst, std::abs(p[i] - q[i]) * static_cast<double>(n));
                if (p[i] * static_cast<double>(n) > 1) {
                    worst_big = std::max(worst_big, std::abs(q[i] / p[i] - 1));
                }
            }
            INFO("n " << n << " defensive " << defensive);
            CHECK(sum == Approx(1).epsilon(1e-12));
            CHECK(worst_big < 1e-6);
            // One column in single precision is 2^-24; the aliases of a bright one add up, but not beyond its own size.
            CHECK(worst < 1e-6 * static_cast<double>(n));
        }
    }
}

TEST_CASE("Dim entries of the alias table keep their own probability") {
    // Each light of 1e-6 among bright ones is picked as often as it should be, so that its rare picks count right.
    std::vector<double> weights(1000, 1.0);
    for (std::size_t i = 0; i < weights.size(); i += 10) {
        weights[i] = 1e-6;
    }
    const std::vector<double> p = pick_probabilities(weights, 0.0);
    const std::vector<double> q = table_probabilities(build_alias_table(p));
    for (std::size_t i = 0; i < weights.size(); i += 10) {
        CHECK(q[i] == Approx(p[i]).epsilon(1e-3));
    }
}

TEST_CASE("Weights of zero, and what is no weight, are never picked") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<double> weights = {0, 1, 0, nan, 2, -3, 0, 1e-300, 0};
    const std::vector<double> p = pick_probabilities(weights, 0.05);
    const std::vector<shared::AliasEntry> table = build_alias_table(p);
    const std::vector<double> q = table_probabilities(table);
    for (const std::size_t i : {0, 2, 3, 5, 6, 8}) {
        CHECK(p[i] == 0);
        CHECK(q[i] == 0);
    }
    // By the picking itself, at both ends of the random words.
    for (std::uint32_t column = 0; column < table.size(); ++column) {
        for (const std::uint32_t bits : {0U, 1U, 0x7fffffffU, 0xffffff00U, 0xffffffffU}) {
            CHECK(p[shared::alias_pick(table[column], column, bits)] > 0);
        }
    }
    for (const std::size_t i : {1, 4, 7}) {
        CHECK(q[i] == Approx(p[i]).epsilon(1e-6));
    }
}

TEST_CASE("The defensive share is spread evenly over what can be picked") {
    const std::vector<double> p = pick_probabilities(std::vector<double>{1, 1e-12, 0, 1e12, 0}, 0.05);
    CHECK(p[1] == Approx(0.05 / 3).epsilon(1e-6));
    CHECK(p[0] == Approx(0.05 / 3).epsilon(1e-6));
    CHECK(p[3] == Approx(0.95 + 0.05 / 3).epsilon(1e-6));
    CHECK(p[2] == 0);
}

TEST_CASE("Weights without bound or without any size give sound tables") {
    const double infinity = std::numeric_limits<double>::infinity();
    const std::vector<double> p = pick_probabilities(std::vector<double>{infinity, 1e308, 1e308, 1}, 0.05);
    CHECK(p[0] + p[1] + p[2] + p[3] == Approx(1).epsilon(1e-12));
    const std::vector<double> dark = pick_probabilities(std::vector<double>{0, 0, 0}, 0.05);
    CHECK(dark == std::vector<double>{0, 0, 0});
    CHECK(pick_probabilities(std::vector<double>{}, 0.05).empty());
    const std::vector<double> denormal = pick_probabilities(std::vector<double>{4.9e-324, 4.9e-324}, 0.0);
    CHECK(denormal[0] == Approx(0.5));
}
