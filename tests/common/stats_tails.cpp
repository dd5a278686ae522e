// Sides of heavy tails, and sides that share their random numbers.
#include <algorithm>
#include <cstdio>

#include "catch.h"
#include "error.h"
#include "stats/bias_verdict.h"
#include "stats/kolmogorov_smirnov.h"
#include "stats_runs.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

/// The mean of so many samples u^(-1/1.5): mean 3, no variance. Grey.
TileNoise pareto_noise(int samples) {
    return [=](std::mt19937_64& random) {
        std::uniform_real_distribution<double> uniform(1e-300, 1);
        double mean = 0;
        for (int i = 0; i < samples; ++i) {
            mean += std::pow(uniform(random), -1 / 1.5) / samples;
        }
        return Channels{mean, mean, mean};
    };
}

TileNoise steady_noise(double mean) {
    return [=, noise = grey(normal_noise())](std::mt19937_64& random) {
        const double value = mean * (1 + 1e-3 * (noise(random)[0] - 1));
        return Channels{value, value, value};
    };
}

struct Count {
    int by_p = 0;
    int failed = 0;
    int passed = 0;
    int darker = 0;  // of by_p
};

Count count_verdicts(const TileNoise& noise_a, const TileNoise& noise_b, int repeats, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    Count count;
    for (int i = 0; i < repeats; ++i) {
        const std::vector<RunMeans> a = made_up_runs(random, runs_a_side, 16, noise_a);
        const std::vector<RunMeans> b = made_up_runs(random, runs_a_side, 16, noise_b);
        const TileComparison comparison = compare_runs(a, b, {.resamplings = 0});
        const PairVerdict verdict =
            judge(std::span(&comparison, 1), {.max_half_width = 100, .max_tile_half_width = 100}).front();
        count.by_p += comparison.global_p <= 1e-3 / 3 ? 1 : 0;
        count.darker += comparison.global_p <= 1e-3 / 3 && comparison.bias_percent < 0 ? 1 : 0;
        count.failed += verdict.verdict == Verdict::fail ? 1 : 0;
        count.passed += verdict.verdict == Verdict::pass ? 1 : 0;
    }
    return count;
}

/// One image of noise that both sides have, and what they do not have in common: `apart` of it.
struct CommonRuns {
    std::vector<RunMeans> a;
    std::vector<RunMeans> b;
};

CommonRuns common_runs(std::mt19937_64& random, int tiles, double apart, double factor_a) {
    CommonRuns runs;
    runs.a = made_up_runs(random, runs_a_side, tiles, normal_noise());
    runs.b = runs.a;
    const std::vector<RunMeans> own = made_up_runs(random, runs_a_side, tiles, normal_noise());
    for (std::size_t i = 0; i < runs.a.size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            runs.a[i].image[c] = factor_a * (runs.a[i].image[c] + apart * (own[i].image[c] - 1));
            for (std::size_t tile = 0; tile < runs.a[i].tiles.size(); ++tile) {
                runs.a[i].tiles[tile][c] = factor_a * (runs.a[i].tiles[tile][c] + apart * (own[i].tiles[tile][c] - 1));
            }
        }
    }
    return runs;
}

}  // namespace

TEST_CASE("A side whose tail is not met yet makes no FAIL, and one run that decides no PASS") {
    constexpr int repeats = 1500;
    const Count heavy = count_verdicts(pareto_noise(31), steady_noise(3), repeats, 21);
    std::printf(
        "samples without a variance, unbiased: the image fails in %d of %d by p, %d of them dark; %d FAIL, %d PASS\n",
        heavy.by_p, repeats, heavy.darker, heavy.failed, heavy.passed);
    CHECK(heavy.by_p >= 20);  // what the rule is for: a third of alpha allows 0.5
    CHECK(heavy.darker == heavy.by_p);
    CHECK(heavy.failed <= 4);
    const Count biased = count_verdicts(grey(normal_noise()), steady_noise(1.2), 100, 22);
    CHECK(biased.failed >= 97);
    // A loss of samples that are skewed on both sides alike, but not as rare as that.
    const Count mild =
        count_verdicts(grey(lognormal_noise(2, 256)), shifted(grey(lognormal_noise(2, 256)), 0.2), 100, 23);
    CHECK(mild.failed >= 90);
}

TEST_CASE("Four runs of one tile that lie together by chance make no FAIL, 15 do") {
    // A run's samples of a pixel, spread evenly, hit a small lamp twice or three times.
    const TileNoise noise = [steady = steady_noise(1)](std::mt19937_64& random) {
        const double hits = std::bernoulli_distribution()(random) ? 3 : 2;
        const double value = hits + steady(random)[0];
        return Channels{value, value, value};
    };
    constexpr int repeats = 2000;
    int by_p = 0;
    int failed = 0;
    std::mt19937_64 random(31);
    const auto compare = [&](int runs, const TileNoise& noise_a, const TileNoise& noise_b) {
        const std::vector<RunMeans> a = made_up_runs(random, runs, 1, noise_a);
        const std::vector<RunMeans> b = made_up_runs(random, runs, 1, noise_b);
        return compare_runs(a, b, {.resamplings = 0});
    };
    for (int i = 0; i < repeats; ++i) {
        const TileComparison comparison = compare(4, noise, noise);
        by_p += comparison.global_p <= 1e-3 / 3 ? 1 : 0;
        failed += judge(std::span(&comparison, 1), {}).front().verdict == Verdict::fail ? 1 : 0;
    }
    std::printf("four runs of few events, unbiased: the image fails in %d of %d by p; %d FAIL\n", by_p, repeats,
                failed);
    CHECK(by_p >= 8);    // what the rule is for: a third of alpha allows 0.7
    CHECK(failed <= 2);  // alpha
    const auto darker = [&](int runs) {
        const TileComparison comparison = compare(runs, steady_noise(0.9), steady_noise(1));
        return judge(std::span(&comparison, 1), {}).front();
    };
    CHECK(darker(6).verdict == Verdict::inconclusive);
    CHECK(std::ceil(6 * darker(6).more_runs) == 15);
    CHECK(darker(6).reason.find("6 runs") != std::string::npos);
    CHECK(darker(15).verdict == Verdict::fail);
}

TEST_CASE("The brighter side's tail excuses nothing") {
    TileComparison comparison;
    comparison.global_p = 1e-6;
    comparison.standard_error_percent = 0.04;
    comparison.tail_a = {32, 3, 0.1, 0.6};
    comparison.bias_percent = -4;
    CHECK(judge(std::span(&comparison, 1), {}).front().verdict == Verdict::inconclusive);
    comparison.bias_percent = 4;
    CHECK(judge(std::span(&comparison, 1), {}).front().verdict == Verdict::fail);
    comparison.global_p = 0.5;
    const PairVerdict verdict = judge(std::span(&comparison, 1), {}).front();
    CHECK(verdict.verdict == Verdict::inconclusive);
    CHECK(verdict.reason.find("60 %") != std::string::npos);
    comparison.standard_error_percent = 1e-5;  // of rounding alone
    CHECK(judge(std::span(&comparison, 1), {}).front().verdict == Verdict::pass);
    comparison.standard_error_percent = 0.04;
    comparison.tail_a.runs = 4;  // normal runs do that
    CHECK(judge(std::span(&comparison, 1), {}).front().verdict == Verdict::pass);
    comparison.tail_a = {};
    CHECK(judge(std::span(&comparison, 1), {}).front().verdict == Verdict::pass);
}

TEST_CASE("The skewness of runs is that of their sum of independent tiles, in any unit of radiance") {
    for (const double unit : {1e-3, 1.0, 1e3}) {
        std::vector<RunMeans> a;
        std::vector<RunMeans> b;
        for (const double x : {0.0, 0.0, 0.0, 1.0}) {  // g1 = 2 / sqrt(3); of the mirrored values its opposite
            const double values[] = {unit * (1 + x), unit * (2 - x)};
            a.push_back({.image = {values[0], values[0], values[0]}, .tiles = {4, {values[0], values[0], values[0]}}});
            b.push_back({.image = {values[1], values[1], values[1]}, .tiles = {4, {values[1], values[1], values[1]}}});
        }
        const TileComparison c = compare_runs(a, b, {.resamplings = 0});
        CAPTURE(unit);
        CHECK(c.tail_a.skewness == Approx(2 / std::sqrt(3.0) / 2));  // four tiles: by the root of their number less
        CHECK(c.tail_b.skewness == Approx(-2 / std::sqrt(3.0) / 2));
        CHECK(c.tail_a.skewness_error == Approx(std::sqrt(6.0 / 4) / 4));
        CHECK(c.tail_a.largest_share == Approx(0.75));
    }
}

TEST_CASE("An interval has the bias in its middle, and twice its half width") {
    std::mt19937_64 random(8);
    const auto a = made_up_runs(random, 12, 4, scaled(grey(normal_noise()), 1.3));
    const auto b = made_up_runs(random, 12, 4, grey(normal_noise()));
    const TileComparison c = compare_runs(a, b, {.resamplings = 0});
    CHECK(c.bias_percent == Approx(30).margin(12));
    CHECK(c.ci95_percent[0] + c.ci95_percent[1] == Approx(2 * c.bias_percent));
    CHECK(c.ci95_percent[1] - c.ci95_percent[0] == Approx(2 * c.half_width_percent));  // grey: every channel's
}

TEST_CASE("Six runs a side have too few draws of signs for 400, seven have enough") {
    for (const int count : {6, 7}) {  // C(6, 3)^2 / 2 = 200, C(7, 3)^2 / 2 = 612
        std::mt19937_64 random(9);
        const auto a = made_up_runs(random, count, 16, normal_noise());
        const auto b = made_up_runs(random, count, 16, normal_noise());
        const double one = compare_runs(a, b, {.resamplings = 400, .seed = 1}).fisher_p;
        const double other = compare_runs(a, b, {.resamplings = 400, .seed = 2}).fisher_p;
        CAPTURE(count, one, other);
        CHECK((one != other) == (count == 7));  // drawn with that seed, or not drawn
    }
}

TEST_CASE("Common seeds leave what differs, as wide as it is") {
    std::mt19937_64 random(31);
    std::vector<double> global;
    std::vector<double> tiles;
    int covered = 0;
    constexpr int repeats = 400;
    for (int i = 0; i < repeats; ++i) {
        const CommonRuns runs = common_runs(random, 4, 0.01, 1);
        const TileComparison c = compare_common_runs(runs.a, runs.b, {.resamplings = 0});
        global.push_back(c.global_p);
        for (const TileOutcome& tile : c.tiles) {
            tiles.push_back(tile.p);
        }
        covered += c.ci95_percent[0] <= 0 && c.ci95_percent[1] >= 0 ? 1 : 0;
        CHECK(c.half_width_percent < 0.05);
        CHECK(compare_runs(runs.a, runs.b, {.resamplings = 0}).half_width_percent > 1);
        CHECK(c.freedom == Approx(runs_a_side - 1));
    }
    CHECK(kolmogorov_smirnov_uniform(global).p > 1e-3);
    CHECK(kolmogorov_smirnov_uniform(tiles).p > 1e-3);
    CHECK(std::abs(covered - 0.95 * repeats) < 3.5 * std::sqrt(repeats * 0.95 * 0.05));

    const CommonRuns biased = common_runs(random, 4, 0.01, 1.001);
    const TileComparison comparison = compare_common_runs(biased.a, biased.b);
    CHECK(comparison.bias_percent == Approx(0.1).margin(0.03));
    CHECK(judge(std::span(&comparison, 1), {}).front().verdict == Verdict::fail);
    const TileComparison one_run = [&] {  // all of the difference in one path that parted
        CommonRuns parted = common_runs(random, 4, 0, 1);
        for (double& channel : parted.a[5].image) {
            channel += 1e-3;
        }
        return compare_common_runs(parted.a, parted.b);
    }();
    CHECK(judge(std::span(&one_run, 1), {}).front().verdict == Verdict::pass);
    // One such path a tile: no two tiles' p differ, nor does their sum under any signs.
    CommonRuns sparse = common_runs(random, 16, 0, 1);
    for (std::size_t tile = 0; tile < 16; ++tile) {
        for (double& channel : sparse.a[2 * tile].tiles[tile]) {
            channel += tile % 2 == 0 ? 0.01 : -0.01;
        }
    }
    const TileComparison partings = compare_common_runs(sparse.a, sparse.b);
    CHECK(partings.tested == 16);
    CHECK(judge(std::span(&partings, 1), {}).front().verdict == Verdict::pass);
    const CommonRuns equal = common_runs(random, 4, 0, 1);
    const TileComparison same = compare_common_runs(equal.a, equal.b);
    CHECK(judge(std::span(&same, 1), {}).front().verdict == Verdict::pass);
    CHECK_THROWS_AS(compare_common_runs(std::span(equal.a).first(8), equal.b), Error);
}
