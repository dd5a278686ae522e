// Verdicts, and the way from a film to its tiles.
#include <tuple>

#include "catch.h"
#include "error.h"
#include "render/film_tiles.h"
#include "stats/bias_verdict.h"

using namespace diptych::core;

namespace {

TileComparison comparison_with(double global_p, double half_width, double tile_half_width) {
    TileComparison comparison;
    comparison.global_p = global_p;
    comparison.half_width_percent = half_width;
    comparison.standard_error_percent = half_width / 2;
    comparison.freedom = 62;
    comparison.tile_half_width_percent = tile_half_width;
    comparison.tested = 100;
    return comparison;
}

Verdict verdict_on(const TileComparison& comparison) {
    return judge(std::span(&comparison, 1), {}).front().verdict;
}

}  // namespace

TEST_CASE("PASS wants power, FAIL does not") {
    CHECK(verdict_on(comparison_with(0.3, 0.09, 0.9)) == Verdict::pass);
    CHECK(verdict_on(comparison_with(0.3, 0.11, 0.9)) == Verdict::inconclusive);
    CHECK(verdict_on(comparison_with(0.3, 0.09, 1.1)) == Verdict::inconclusive);
    CHECK(verdict_on(comparison_with(3e-4, 5, 50)) == Verdict::fail);
    CHECK(verdict_on(comparison_with(4e-4, 0.09, 0.9)) == Verdict::pass);  // Holm: three tests
    TileComparison unequal = comparison_with(1, 0, 0);
    unequal.unequal = 1;
    CHECK(verdict_on(unequal) == Verdict::fail);
}

TEST_CASE("An inconclusive verdict says how many samples would tell") {
    const auto judged = [](const TileComparison& comparison) { return judge(std::span(&comparison, 1), {}).front(); };
    CHECK(judged(comparison_with(0.3, 0.09, 0.9)).more_samples == 1);       // PASS
    CHECK(judged(comparison_with(0.3, 0.2, 0.9)).more_samples == Approx(4));  // half the width
    CHECK(judged(comparison_with(0.3, 0.2, 3)).more_samples == Approx(9));
    // Far from 0, but not by what alpha wants: as many as find a bias of that size, not as many as make it narrow.
    TileComparison differs = comparison_with(0.001, 2, 30);
    differs.bias_percent = -3.9;
    differs.ci95_percent[0] = -5.9;
    differs.ci95_percent[1] = -1.9;
    PairVerdict verdict = judged(differs);
    CHECK(verdict.verdict == Verdict::inconclusive);
    CHECK(verdict.reason.find("leaves 0 out") != std::string::npos);
    const double needed = verdict.min_detectable_percent / 3.9;
    CHECK(verdict.more_samples == Approx(std::max(2.0, needed * needed)));
    CHECK(verdict.more_samples < 10);
    // Too skewed to be believed: skewness falls as the root of the samples, to 0.4.
    differs.global_p = 1e-9;
    differs.tail_a.skewness = 1.2;
    differs.tail_a.skewness_error = 0.1;
    verdict = judged(differs);
    CHECK(verdict.verdict == Verdict::inconclusive);
    CHECK(verdict.more_samples == Approx(9));
}

TEST_CASE("An interval leaves 0 out if it lies on one side of it, however close") {
    TileComparison comparison;
    for (const auto& [low, high, excludes] : {std::tuple{0.01, 0.5, true}, {-0.5, -0.01, true}, {-0.01, 0.5, false}, {-0.5, 0.01, false}}) {
        comparison.ci95_percent[0] = low;
        comparison.ci95_percent[1] = high;
        CAPTURE(low, high);
        CHECK(excludes_zero(comparison) == excludes);
    }
}

TEST_CASE("One run decides if it holds nearly all of a variance that is more than rounding") {
    TileComparison comparison;
    comparison.tail_a.runs = 16;
    comparison.tail_a.largest_share = 0.99;
    const double rounding_percent = 100 * channel_rounding;
    comparison.standard_error_percent = 1.02 * rounding_percent;
    CHECK(single_run_decides(comparison));
    comparison.common_seeds = true;
    CHECK_FALSE(single_run_decides(comparison));
    comparison.common_seeds = false;
    comparison.standard_error_percent = 0.98 * rounding_percent;
    CHECK_FALSE(single_run_decides(comparison));
    comparison.standard_error_percent = 1.02 * rounding_percent;
    comparison.tail_a.largest_share = 0.4;
    CHECK_FALSE(single_run_decides(comparison));
    std::swap(comparison.tail_a, comparison.tail_b);
    comparison.tail_b.largest_share = 0.99;
    CHECK(single_run_decides(comparison));
}

TEST_CASE("Tiles alone fail no pair whose tails are lopsided, the image mean does") {
    TileComparison comparison = comparison_with(0.3, 0.01, 0.1);
    comparison.fisher_p = 1e-9;
    CHECK(verdict_on(comparison) == Verdict::fail);
    comparison.heavy_a = 30;
    CHECK(verdict_on(comparison) == Verdict::inconclusive);
    comparison.heavy_b = 29;  // on both sides: no harm
    CHECK(verdict_on(comparison) == Verdict::fail);
    comparison.heavy_b = 0;
    comparison.global_p = 1e-5;
    CHECK(verdict_on(comparison) == Verdict::fail);
}

TEST_CASE("Pairs are judged together") {
    std::vector<TileComparison> comparisons(10, comparison_with(0.5, 0.05, 0.5));
    comparisons[3].global_p = 5e-5;  // 30 tests: not below 1e-3 / 30
    std::vector<PairVerdict> verdicts = judge(comparisons, {});
    CHECK(verdicts[3].adjusted_p == Approx(30 * 5e-5));
    CHECK(overall(verdicts) == Verdict::pass);
    comparisons[3].global_p = 3e-5;
    comparisons[7].half_width_percent = 1;
    verdicts = judge(comparisons, {});
    CHECK(verdicts[3].verdict == Verdict::fail);
    CHECK(verdicts[7].verdict == Verdict::inconclusive);
    CHECK(overall(verdicts) == Verdict::fail);
    verdicts.erase(verdicts.begin() + 3);
    CHECK(overall(verdicts) == Verdict::inconclusive);
    // More pairs: each has to be clearer, so the least detectable bias grows.
    CHECK(verdicts[0].min_detectable_percent >
          judge(std::span(comparisons.data(), 1), {}).front().min_detectable_percent);
}

TEST_CASE("Constant tiles that agree are left aside, and disagreement fails") {
    const auto runs = [](double tile) {
        std::vector<RunMeans> result;
        for (int i = 0; i < 4; ++i) {
            const double noise = 0.01 * i;
            result.push_back({{1, 1, 1}, {{tile, tile, tile}, {0, 0, 0}, {1 + noise, 1, 1}}});
        }
        return result;
    };
    const TileComparison same = compare_runs(runs(2), runs(2));
    CHECK(same.tested == 1);
    CHECK(same.unequal == 0);
    CHECK(same.global_p == 1);
    CHECK_FALSE(same.tiles[1].lit);
    const TileComparison other = compare_runs(runs(2), runs(2.01));
    CHECK(other.unequal == 1);
    CHECK(other.local_p == 0);
    CHECK_THROWS_AS(compare_runs(std::span<const RunMeans>(runs(2)).first(1), runs(2)), Error);
}

TEST_CASE("A film becomes the means of its tiles, the last ones cut") {
    Film film;
    film.width = 5;
    film.height = 3;
    film.pixels.resize(15);
    for (std::size_t i = 0; i < 15; ++i) {
        const float x = static_cast<float>(i % 5);
        const float y = static_cast<float>(i / 5);
        shared::film_add(film.pixels[i], {x, y, 1}, 1);
        shared::film_add(film.pixels[i], {x + 2, y, 1}, 1);
    }
    CHECK(tile_grid(5, 3, 2).columns == 3);
    CHECK(tile_grid(5, 3, 2).rows == 2);
    const RunMeans means = tile_means(film, 2);
    REQUIRE(means.tiles.size() == 6);
    CHECK(means.tiles[0] == Channels{1.5, 0.5, 1});
    CHECK(means.tiles[2] == Channels{5, 0.5, 1});
    CHECK(means.tiles[5] == Channels{5, 2, 1});
    CHECK(means.image[0] == Approx(3));
    CHECK(means.image[1] == Approx(1));
    RunMeans more = means;
    more.image[0] = 6;
    more.tiles[0][0] = 4.5;
    const RunMeans merged = merge_means(means, 2, more, 4);
    CHECK(merged.image[0] == Approx(5));
    CHECK(merged.tiles[0][0] == Approx(3.5));
}
