// Two sets of renders with seeds of their own: have they one expectation, in the whole image and in every tile of it?
// (After Jung, Hanika and Dachsbacher 2020, "Detecting Bias in Monte Carlo Renderers using Welch's t-test".)
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "stats/channel_test.h"

namespace diptych::core {

/// One run: a render with a seed of its own. Samples within a run may depend on one another (a Sobol' set does); runs
/// do not, so the run's mean is the unit of all that follows, and there is no trimming of it. Linear radiance.
struct RunMeans {
    Channels image{};
    std::vector<Channels> tiles;  // in any order that all runs share
};

struct TileTestOptions {
    double confidence = 0.95;   // of the intervals
    int resamplings = 400;      // for the null distribution of Fisher's sum; below 2, independent tiles are assumed
    std::uint32_t seed = 1;     // of those
    bool common_seeds = false;  // compare_common_runs's to set
};

struct TileOutcome {
    ChannelState state = ChannelState::equal;
    double p = 1;                   // channel_p
    double half_width_percent = 0;  // of the luminance's difference, relative to side b (a where b is black)
    bool lit = false;               // brighter than a thousandth of the image
};

/// What the runs of one side say about rare events, by luminance.
struct RunTail {
    std::size_t runs = 0;
    /// Of the image mean over the runs: third moments of independent tiles add up, and their sum is far better known
    /// than the moment of the few image means.
    double skewness = 0;
    double skewness_error = 0;  // its standard error, were the runs normal
    double largest_share = 0;   // of the image means' sum of squares about their mean, in one run
};

struct TileComparison {
    Channels mean_a{};
    Channels mean_b{};

    // Image mean. Percentages of side b's; b's own error is of second order and left out.
    double bias_percent = 0;  // luminance
    double ci95_percent[2] = {0, 0};
    Channels channel_bias_percent{};
    // The widest of the channels, those below 1 % of the brightest left aside, so that no hue hides behind green:
    double half_width_percent = 0;
    double standard_error_percent = 0;
    double freedom = 0;
    double global_p = 1;  // channel_p
    bool common_seeds = false;
    RunTail tail_a;
    RunTail tail_b;

    // Tiles.
    double fisher_p = 1;      // of all tested tiles together
    double min_p = 1;         // least of all, as it is
    double local_p = 1;       // that, corrected for their number (Šidák)
    std::size_t tested = 0;   // tiles that vary
    std::size_t unequal = 0;  // constant tiles that differ: bias without doubt
    std::size_t heavy_a =
        0;  // tested tiles in which one run of that side holds over half of its variance: too few samples to see
    std::size_t heavy_b = 0;             //   what is rare there
    double tile_half_width_percent = 0;  // median over the lit tiles
    double resolved_share = 1;           // lit tiles of at most 1 %
    std::vector<TileOutcome> tiles;
};

/// At least two runs a side, all with the same tiles; Error otherwise.
///
/// Fisher's sum of the tiles' p-values has its mean and variance from the same sum over draws without a difference:
/// each run's deviation from its side's mean, all of its tiles together, with a random sign (the wild bootstrap: Wu
/// 1986, Liu 1988). So heavy tails, tiles that depend on one another and the discreteness of rare events, which all
/// make p-values a little uneven and add up over a thousand tiles, are in the null distribution too, and each side
/// keeps its own variance. The sum is then judged as a scaled chi-square. Runs too few for so many different draws (six
/// a side for 400) have their tiles merged in a way that needs none and finds less: merged_p.
TileComparison compare_runs(std::span<const RunMeans> a, std::span<const RunMeans> b,
                            const TileTestOptions& options = {});

/// The same where run k of both sides has one seed, so that a path often differs between them by rounding alone
/// (common random numbers): the runs' differences are the draws, and T² is Hotelling's of one sample. As the mean
/// difference has the same expectation, nothing is hidden that independent seeds would show; what both sides have in
/// common no longer widens the interval. As many runs on either side.
TileComparison compare_common_runs(std::span<const RunMeans> a, std::span<const RunMeans> b,
                                   const TileTestOptions& options = {});

}  // namespace diptych::core
