#include "stats/bias_verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "stats/distributions.h"
#include "stats/multiple_testing.h"
#include "stats/power.h"

namespace diptych::core {

namespace {

constexpr std::size_t tests_a_pair = 3;
constexpr double lopsided_share = 0.01;
constexpr double lopsided_count = 2;
constexpr double harmless_skewness = 0.4;
constexpr double skewed_deviations = 2.5;
constexpr double telling_error = 0.65;
constexpr double decisive_share = 0.5;
constexpr double decisive_p = 1e-4;

/// Beyond half, and beyond what the largest of so many normal values holds once in ten thousand times (Grubbs 1950).
bool holds_too_much(const RunTail& tail) {
    const double n = static_cast<double>(tail.runs);
    if (n < 3) {
        return false;
    }
    const double t = student_quantile(1 - decisive_p / (2 * n), n - 2);
    return tail.largest_share > std::max(decisive_share, (n - 1) / n * t * t / (n - 2 + t * t));
}

const RunTail& darker_side(const TileComparison& comparison) {
    return comparison.bias_percent < 0 ? comparison.tail_a : comparison.tail_b;
}

std::string failure(const TileComparison& comparison, std::span<const double> adjusted, double alpha) {
    if (comparison.unequal > 0) {
        return fmt::format("{} tiles without any noise differ, or are not finite", comparison.unequal);
    }
    if (lopsided_tails(comparison)) {
        return "the image mean differs";
    }
    std::string reason;
    const char* names[tests_a_pair] = {"the image mean", "the tiles together", "single tiles"};
    for (std::size_t i = 0; i < tests_a_pair; ++i) {
        if (adjusted[i] <= alpha) {
            reason += fmt::format("{}{} differ{}", reason.empty() ? "" : ", ", names[i], i == 0 ? "s" : "");
        }
    }
    return reason;
}

std::string tail_warning(const TileComparison& comparison) {
    return fmt::format(
        "tiles differ, but single runs carry {} of {} tiles on one side and {} on the other: too few samples "
        "to tell a loss from what was not met yet",
        std::max(comparison.heavy_a, comparison.heavy_b), comparison.tested,
        std::min(comparison.heavy_a, comparison.heavy_b));
}

std::string skewness_warning(const TileComparison& comparison) {
    const RunTail& tail = darker_side(comparison);
    return fmt::format("differs, but the darker side's runs are skewed ({:.1f}, one holds {:.0f} % of their variance): "
                       "too few samples "
                       "to tell a loss from bright ones not met yet",
                       tail.skewness, 100 * tail.largest_share);
}

double squared(double x) {
    return x * x;
}

std::string few_runs_warning(const TileComparison& comparison) {
    return fmt::format("differs, but {} runs do not tell how skewed the darker side is (to {:.1f}): too few to tell a "
                       "loss from what was not met yet",
                       darker_side(comparison).runs, darker_side(comparison).skewness_error);
}

/// How many times the samples an inconclusive pair wants, were noise and skewness to fall as those of independent
/// samples do. Where the interval leaves 0 out, as many as would find a bias of the size measured.
double wanted_samples(const TileComparison& comparison, const PairVerdict& verdict, const VerdictLimits& limits) {
    constexpr double untold = 4;  // where no figure says how many: half the noise
    const double skewness =
        unmet_tail(comparison) ? squared(darker_side(comparison).skewness / harmless_skewness) : 1;
    const double tail = lopsided_tails(comparison) || single_run_decides(comparison) ? untold : 1;
    const double power = std::max(squared(comparison.half_width_percent / limits.max_half_width),
                                  squared(comparison.tile_half_width_percent / limits.max_tile_half_width));
    const double bias = std::max(squared(verdict.min_detectable_percent / comparison.bias_percent), 2.0);
    const double factor = std::max({excludes_zero(comparison) ? bias : power, skewness, tail, 1.0});
    return std::isfinite(factor) ? factor : untold;
}

std::string weakness(const TileComparison& comparison, const VerdictLimits& limits) {
    if (single_run_decides(comparison)) {
        return fmt::format(
            "heavy tail: one run holds {:.0f} % of the image mean's variance, so its interval says little",
            100 * std::max(comparison.tail_a.largest_share, comparison.tail_b.largest_share));
    }
    if (excludes_zero(comparison) && !has_power(comparison, limits)) {
        return fmt::format("the image mean probably differs, as its interval leaves 0 out, but that is no proof at so "
                           "few samples (known to {:.3g} %, {:.3g} % is wanted)",
                           comparison.half_width_percent, limits.max_half_width);
    }
    if (comparison.half_width_percent > limits.max_half_width) {
        return fmt::format("the image mean is known to {:.3g} % only, {:.3g} % is wanted",
                           comparison.half_width_percent, limits.max_half_width);
    }
    return fmt::format("half of the tiles are known to {:.3g} % or worse, {:.3g} % is wanted",
                       comparison.tile_half_width_percent, limits.max_tile_half_width);
}

}  // namespace

const char* name_of(Verdict verdict) {
    switch (verdict) {
    case Verdict::pass:
        return "PASS";
    case Verdict::fail:
        return "FAIL";
    default:
        return "INCONCLUSIVE";
    }
}

bool excludes_zero(const TileComparison& comparison) {
    return comparison.ci95_percent[0] > 0 || comparison.ci95_percent[1] < 0;
}

bool lopsided_tails(const TileComparison& comparison) {
    const double a = static_cast<double>(comparison.heavy_a);
    const double b = static_cast<double>(comparison.heavy_b);
    return std::abs(a - b) > std::max(lopsided_count, lopsided_share * static_cast<double>(comparison.tested));
}

bool unmet_tail(const TileComparison& comparison) {
    const RunTail& darker = darker_side(comparison);
    return !comparison.common_seeds &&
           darker.skewness > std::max(harmless_skewness, skewed_deviations * darker.skewness_error);
}

bool unknown_tail(const TileComparison& comparison) {
    return !comparison.common_seeds && darker_side(comparison).skewness_error > telling_error;
}

bool single_run_decides(const TileComparison& comparison) {
    return !comparison.common_seeds && comparison.standard_error_percent > 100 * channel_rounding &&
           (holds_too_much(comparison.tail_a) || holds_too_much(comparison.tail_b));
}

bool has_power(const TileComparison& comparison, const VerdictLimits& limits) {
    return std::isfinite(comparison.bias_percent) && !single_run_decides(comparison) &&
           comparison.half_width_percent <= limits.max_half_width &&
           comparison.tile_half_width_percent <= limits.max_tile_half_width;
}

std::vector<PairVerdict> judge(std::span<const TileComparison> comparisons, const VerdictLimits& limits) {
    std::vector<double> p;
    for (const TileComparison& comparison : comparisons) {
        p.insert(p.end(), {comparison.global_p, comparison.fisher_p, comparison.local_p});
    }
    const std::vector<double> adjusted = holm_adjusted(p);
    std::vector<PairVerdict> verdicts;
    for (std::size_t i = 0; i < comparisons.size(); ++i) {
        const TileComparison& comparison = comparisons[i];
        const std::span<const double> own(&adjusted[i * tests_a_pair], tests_a_pair);
        PairVerdict verdict;
        verdict.adjusted_p = *std::min_element(own.begin(), own.end());
        verdict.min_detectable_percent = minimum_detectable(comparison.standard_error_percent, comparison.freedom,
                                                            limits.alpha / static_cast<double>(p.size()), limits.power);
        const double p_that_counts = lopsided_tails(comparison) ? own[0] : verdict.adjusted_p;
        const bool unmet = unmet_tail(comparison);
        const bool unknown = unknown_tail(comparison);
        if ((p_that_counts <= limits.alpha && !unmet && !unknown) || comparison.unequal > 0) {
            verdict.verdict = Verdict::fail;
            verdict.reason = failure(comparison, own, limits.alpha);
        } else if (verdict.adjusted_p <= limits.alpha) {
            verdict.reason = unmet     ? skewness_warning(comparison)
                             : unknown ? few_runs_warning(comparison)
                                       : tail_warning(comparison);
            verdict.more_runs = unknown ? squared(darker_side(comparison).skewness_error / telling_error) : 1;
        } else if (has_power(comparison, limits)) {
            verdict.verdict = Verdict::pass;
            verdict.reason = "no difference, and one would have been seen";
        } else {
            verdict.reason = weakness(comparison, limits);
        }
        if (verdict.verdict == Verdict::inconclusive) {
            verdict.more_samples = wanted_samples(comparison, verdict, limits);
        }
        verdicts.push_back(verdict);
    }
    return verdicts;
}

Verdict overall(std::span<const PairVerdict> verdicts) {
    Verdict worst = Verdict::pass;
    for (const PairVerdict& verdict : verdicts) {
        if (verdict.verdict == Verdict::fail) {
            return Verdict::fail;
        }
        worst = verdict.verdict == Verdict::inconclusive ? Verdict::inconclusive : worst;
    }
    return worst;
}

}  // namespace diptych::core
