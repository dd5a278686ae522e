#include "stats/bias_test.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "error.h"
#include "stats/distributions.h"
#include "stats/multiple_testing.h"
#include "stats/welch.h"

namespace diptych::core {

namespace {

constexpr double heavy_share = 0.5;
constexpr double lit_share = 1e-3;
constexpr double resolved_percent = 1;
constexpr double dim_channel = 0.01;

double luminance(const Channels& rgb) {
    return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

/// One number of every run, such as a channel of a tile.
template <class Pick>
std::vector<double> series(std::span<const RunMeans> runs, const Pick& pick) {
    std::vector<double> values;
    for (const RunMeans& run : runs) {
        values.push_back(pick(run));
    }
    return values;
}

template <class Pick>
WelchTest welch(std::span<const RunMeans> a, std::span<const RunMeans> b, const Pick& pick) {
    return welch_test(series(a, pick), series(b, pick));
}

template <class Pick>
double mean_of(std::span<const RunMeans> runs, const Pick& pick) {
    return summarize(series(runs, pick)).mean;
}

/// 0/0 is 0: black on both sides.
double percent(double part, double whole) {
    return part == 0 ? 0 : 100 * part / std::abs(whole);
}

double nonzero_mean(double mean_a, double mean_b) {
    return mean_b != 0 ? mean_b : mean_a;
}

/// Central moments over the runs, of a sum of independent tiles.
struct TileMoments {
    double second = 0;
    double third = 0;
    double second_cubed = 0;  // sum of the tiles' own

    void add(const std::vector<double>& values) {
        const double mean = summarize(values).mean;
        const double n = static_cast<double>(values.size());
        double squares = 0;
        for (const double value : values) {
            squares += (value - mean) * (value - mean) / n;
            third += std::pow(value - mean, 3) / n;
        }
        second += squares;
        second_cubed += squares * squares * squares;
    }
    /// Of normal values, g1 has about the variance 6/n.
    void describe(std::size_t runs, RunTail& tail) const {
        if (second > 0) {
            const double scale = std::pow(second, 1.5);
            tail.skewness = third / scale;
            tail.skewness_error = std::sqrt(6 * second_cubed / static_cast<double>(runs)) / scale;
        }
    }
};

double largest_share(const std::vector<double>& values) {
    const SampleSummary summary = summarize(values);
    double largest = 0;
    for (const double value : values) {
        largest = std::max(largest, (value - summary.mean) * (value - summary.mean));
    }
    return largest > 0 ? largest / (summary.variance * (summary.count - 1)) : 0;
}

/// One run holds over half of the sum of squares: for normal runs, one in ten thousand at 32 of them.
bool is_heavy(const std::vector<double>& values) {
    return largest_share(values) > heavy_share;
}

void compare_images(std::span<const RunMeans> a, std::span<const RunMeans> b, double confidence,
                    TileComparison& result) {
    std::vector<Channels> images_a;
    std::vector<Channels> images_b;
    for (const RunMeans& run : a) {
        images_a.push_back(run.image);
    }
    for (const RunMeans& run : b) {
        images_b.push_back(run.image);
    }
    result.global_p = channel_p(channel_runs(images_a, images_b));
    double brightest = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        const auto pick = [c](const RunMeans& run) { return run.image[c]; };
        result.mean_a[c] = mean_of(a, pick);
        result.mean_b[c] = mean_of(b, pick);
        brightest = std::max(brightest, nonzero_mean(result.mean_a[c], result.mean_b[c]));
    }
    const auto image_luminance = [](const RunMeans& run) { return luminance(run.image); };
    const WelchTest test = welch(a, b, image_luminance);
    result.tail_a.runs = a.size();
    result.tail_b.runs = b.size();
    result.tail_a.largest_share = largest_share(series(a, image_luminance));
    result.tail_b.largest_share = largest_share(series(b, image_luminance));
    const double whole = nonzero_mean(luminance(result.mean_a), luminance(result.mean_b));
    const double half_width = confidence_half_width(test, confidence);
    result.bias_percent = percent(test.difference, whole);
    result.ci95_percent[0] = percent(test.difference - half_width, whole);
    result.ci95_percent[1] = percent(test.difference + half_width, whole);
    result.freedom = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < 3; ++c) {
        const WelchTest channel = welch(a, b, [c](const RunMeans& run) { return run.image[c]; });
        const double channel_whole = nonzero_mean(result.mean_a[c], result.mean_b[c]);
        result.channel_bias_percent[c] = percent(channel.difference, channel_whole);
        const double width = percent(confidence_half_width(channel, confidence), channel_whole);
        if (channel_whole >= dim_channel * brightest && width > result.half_width_percent) {
            result.half_width_percent = width;
            result.standard_error_percent = percent(channel.standard_error, channel_whole);
            result.freedom = channel.freedom;
        }
    }
}

/// As many of +1 as of -1, but for one; in random order.
void draw_signs(std::span<double> sign, std::mt19937_64& random) {
    for (std::size_t i = 0; i < sign.size(); ++i) {
        sign[i] = i % 2 == 0 ? 1 : -1;
    }
    std::shuffle(sign.begin(), sign.end(), random);
}

/// Half the number of ways to draw signs for so many runs: a draw and its mirror image give the same p-values.
double distinct_draws(std::size_t count_a, std::size_t count_b) {
    const auto ways = [](std::size_t count) {
        const double n = static_cast<double>(count);
        return std::exp(std::lgamma(n + 1) - std::lgamma(std::floor(n / 2) + 1) - std::lgamma(std::ceil(n / 2) + 1));
    };
    return ways(count_a) * ways(count_b) / 2;
}

double combined_p(const std::vector<ChannelRuns>& tested, const std::vector<double>& p_values,
                  const TileTestOptions& options) {
    if (options.resamplings < 2) {
        return fisher_combined(p_values);
    }
    if (tested.empty()) {
        return 1;
    }
    const std::size_t count_a = tested.front().count_a;
    const std::size_t count_b = tested.front().count_b;
    // A handful of draws, each of them met many times, tells nothing of how far the sum spreads.
    if (std::min(count_a, count_b) < 3 ||
        distinct_draws(count_a, options.common_seeds ? 0 : count_b) < options.resamplings) {
        return merged_p(p_values);
    }
    std::vector<double> sign(count_a + count_b);
    std::mt19937_64 random(options.seed);
    std::vector<double> sums;
    std::vector<double> p(tested.size());
    for (int i = 0; i < options.resamplings; ++i) {
        draw_signs(std::span(sign).first(count_a), random);
        draw_signs(std::span(sign).last(count_b), random);
        std::transform(tested.begin(), tested.end(), p.begin(),
                       [&](const ChannelRuns& tile) { return resampled_channel_p(tile, sign); });
        sums.push_back(fisher_statistic(p));
    }
    const SampleSummary null = summarize(sums);
    return scaled_chi_square_upper(fisher_statistic(p_values), null.mean, null.variance);
}

void compare_tiles(std::span<const RunMeans> a, std::span<const RunMeans> b, const TileTestOptions& options,
                   TileComparison& result) {
    const double lit = lit_share * std::max(luminance(result.mean_a), luminance(result.mean_b));
    std::vector<ChannelRuns> summed;
    std::vector<double> p_values;
    std::vector<double> lit_half_widths;
    TileMoments moments_a;
    TileMoments moments_b;
    std::vector<Channels> runs_a(a.size());
    std::vector<Channels> runs_b(b.size());
    for (std::size_t tile = 0; tile < a.front().tiles.size(); ++tile) {
        const auto pick = [tile](const RunMeans& run) { return run.tiles[tile]; };
        std::transform(a.begin(), a.end(), runs_a.begin(), pick);
        std::transform(b.begin(), b.end(), runs_b.begin(), pick);
        ChannelRuns runs = channel_runs(runs_a, runs_b);
        TileOutcome outcome;
        outcome.state = runs.state;
        outcome.p = channel_p(runs);
        const auto tile_luminance = [tile](const RunMeans& run) { return luminance(run.tiles[tile]); };
        const std::vector<double> values_a = series(a, tile_luminance);
        const std::vector<double> values_b = series(b, tile_luminance);
        const double whole = nonzero_mean(summarize(values_a).mean, summarize(values_b).mean);
        outcome.lit = whole > lit;
        outcome.half_width_percent =
            percent(confidence_half_width(welch_test(values_a, values_b), options.confidence), whole);
        moments_a.add(values_a);
        moments_b.add(values_b);
        if (outcome.lit) {
            lit_half_widths.push_back(outcome.half_width_percent);
        }
        result.min_p = std::min(result.min_p, outcome.p);
        if (outcome.state == ChannelState::tested) {
            result.heavy_a += is_heavy(values_a) ? 1 : 0;
            result.heavy_b += is_heavy(values_b) ? 1 : 0;
            // One path that parted says nothing of a mean, and its p, one and the same under either sign, has no
            // distribution to add up with the others'.
            if (!options.common_seeds || !is_heavy(values_a)) {
                p_values.push_back(outcome.p);
                summed.push_back(std::move(runs));
            }
            ++result.tested;
        }
        result.unequal += outcome.state == ChannelState::unequal ? 1 : 0;
        result.tiles.push_back(outcome);
    }
    moments_a.describe(a.size(), result.tail_a);
    moments_b.describe(b.size(), result.tail_b);
    result.fisher_p = combined_p(summed, p_values, options);
    result.local_p = sidak_adjusted(result.min_p, static_cast<double>(std::max<std::size_t>(result.tested, 1)));
    if (!lit_half_widths.empty()) {
        std::sort(lit_half_widths.begin(), lit_half_widths.end());
        result.tile_half_width_percent = lit_half_widths[lit_half_widths.size() / 2];
        const auto resolved = std::upper_bound(lit_half_widths.begin(), lit_half_widths.end(), resolved_percent);
        result.resolved_share =
            static_cast<double>(resolved - lit_half_widths.begin()) / static_cast<double>(lit_half_widths.size());
    }
}

void check_runs(std::span<const RunMeans> a, std::span<const RunMeans> b) {
    if (a.size() < 2 || b.size() < 2) {
        throw Error("a test of bias wants two runs a side or more");
    }
    for (const std::span<const RunMeans> side : {a, b}) {
        for (const RunMeans& run : side) {
            if (run.tiles.size() != a.front().tiles.size()) {
                throw Error("a test of bias wants the same tiles in all runs");
            }
        }
    }
}

void accumulate(Channels& sum, const Channels& value, double factor) {
    for (std::size_t c = 0; c < 3; ++c) {
        sum[c] += factor * value[c];
    }
}

/// sum += factor * run, in every number of it.
void accumulate(RunMeans& sum, const RunMeans& run, double factor) {
    accumulate(sum.image, run.image, factor);
    for (std::size_t tile = 0; tile < run.tiles.size(); ++tile) {
        accumulate(sum.tiles[tile], run.tiles[tile], factor);
    }
}

}  // namespace

TileComparison compare_runs(std::span<const RunMeans> a, std::span<const RunMeans> b, const TileTestOptions& options) {
    check_runs(a, b);
    TileComparison result;
    compare_images(a, b, options.confidence, result);
    compare_tiles(a, b, options, result);
    return result;
}

TileComparison compare_common_runs(std::span<const RunMeans> a, std::span<const RunMeans> b,
                                   const TileTestOptions& options) {
    check_runs(a, b);
    if (a.size() != b.size()) {
        throw Error("runs of common seeds come in pairs");
    }
    RunMeans mean{{}, std::vector<Channels>(b.front().tiles.size())};
    for (const RunMeans& run : b) {
        accumulate(mean, run, 1 / static_cast<double>(b.size()));
    }
    // One side b's mean, without noise; the other that mean and each pair's difference: Welch's test is Student's then.
    std::vector<RunMeans> differences(a.size(), mean);
    for (std::size_t run = 0; run < a.size(); ++run) {
        accumulate(differences[run], a[run], 1);
        accumulate(differences[run], b[run], -1);
    }
    TileTestOptions common = options;
    common.common_seeds = true;
    TileComparison result = compare_runs(differences, std::vector<RunMeans>(b.size(), mean), common);
    result.common_seeds = true;
    result.heavy_b = result.heavy_a;  // a path that parts is as likely the brighter one on either side
    return result;
}

}  // namespace diptych::core
