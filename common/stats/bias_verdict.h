// From comparisons to verdicts, over all pairs of one suite.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "stats/tile_test.h"

namespace diptych {

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
};

/// Whether the intervals are narrow enough to tell.
bool has_power(const TileComparison& comparison, const VerdictLimits& limits);

/// Whether single runs carry many more tiles on one side than on the other (more than 1 % of them). Then that side has
/// not met its rare events often enough: a tile where they are missing looks like a loss, and a t-test finds it far
/// oftener than alpha. The image mean, in which all tiles' events meet, still holds. Equal tails on both sides do no
/// harm: the difference is symmetric.
bool lopsided_tails(const TileComparison& comparison);

/// Image mean, Fisher's combination and the least tile of every pair go through Holm's procedure together, so one false
/// FAIL among all pairs has probability alpha at most. FAIL wants no power; PASS does. Under lopsided tails, tiles
/// alone make no FAIL but INCONCLUSIVE.
std::vector<PairVerdict> judge(std::span<const TileComparison> comparisons, const VerdictLimits& limits);

/// FAIL where one fails, else INCONCLUSIVE where one is.
Verdict overall(std::span<const PairVerdict> verdicts);

}  // namespace diptych
