// From comparisons to verdicts, over all pairs of one suite.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "stats/bias_test.h"

namespace diptych::core {

enum class Verdict { pass, fail, inconclusive };

/// "PASS", "FAIL", "INCONCLUSIVE".
const char* name_of(Verdict verdict);

struct VerdictLimits {
    double alpha = 1e-3;             // family-wise, over three tests of each pair
    double max_half_width = 0.1;     // percent; of the image mean, 95 %
    double max_tile_half_width = 1;  // percent; of the median lit tile, 95 %
    double power = 0.9;              // for the least bias that would be found
};

struct PairVerdict {
    Verdict verdict = Verdict::inconclusive;
    double adjusted_p = 1;              // least of the pair's three, by Holm over the suite: FAIL at alpha or less
    double min_detectable_percent = 0;  // bias of the image mean's widest channel that the suite finds with that power
    std::string reason;                 // one clause
    double more_samples = 1;            // where inconclusive: how many times the samples would tell; an estimate
    double more_runs = 1;               // how many times the runs, where their number is what lacks
};

/// Whether the intervals are narrow enough to tell.
bool has_power(const TileComparison& comparison, const VerdictLimits& limits);

/// Whether the 95 % interval of the image mean leaves 0 out.
bool excludes_zero(const TileComparison& comparison);

/// Whether single runs carry many more tiles on one side than on the other (more than 1 % of them). Then that side has
/// not met its rare events often enough: a tile where they are missing looks like a loss, and a t-test finds it far
/// oftener than alpha. The image mean, in which all tiles' events meet, still holds. Equal tails on both sides do no
/// harm: the difference is symmetric.
bool lopsided_tails(const TileComparison& comparison);

/// Whether the darker side's runs are skewed to the bright. Then rare bright samples hold much of the mean, and what
/// the side has not met of them looks like a loss: t-tests fail such sides up to a hundred times as often as alpha
/// says, all to the dark, where the skewness that the tiles show exceeds 0.4. The brighter side's skewness explains
/// nothing away, nor does that of differences of common seeds, in which either side's bright samples have their own
/// sign.
bool unmet_tail(const TileComparison& comparison);

/// Whether the runs and tiles tell the darker side's skewness to no better than 0.65: fewer than 15 runs of one tile, or
/// fewer than four runs of four tiles alike. Then unmet_tail is blind, and so few runs may lie close together by chance.
/// Never where seeds are common.
bool unknown_tail(const TileComparison& comparison);

/// Whether one run holds over half of the image mean's variance on a side, and more than one of so few normal runs
/// would: then the variance itself is a matter of chance, and an interval made of it no interval. Never where seeds are
/// common: there one path that parts may make all of a minute variance.
bool single_run_decides(const TileComparison& comparison);

/// Image mean, Fisher's combination and the least tile of every pair go through Holm's procedure together, so one false
/// FAIL among all pairs has probability alpha at most. FAIL wants no power; PASS does. Under lopsided tails, tiles
/// alone make no FAIL but INCONCLUSIVE; with an unmet or unknown tail nothing does but constants that differ. Where a
/// single run decides, there is no PASS.
std::vector<PairVerdict> judge(std::span<const TileComparison> comparisons, const VerdictLimits& limits);

/// FAIL where one fails, else INCONCLUSIVE where one is.
Verdict overall(std::span<const PairVerdict> verdicts);

}  // namespace diptych::core
