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
    double more_samples = 1;            // if inconclusive: the samples needed, relative to those taken; an estimate
    double more_runs = 1;               // if there are too few runs: the runs needed, relative to those taken
};

/// Whether the intervals are narrow enough for PASS, and no single run decides.
bool has_power(const TileComparison& comparison, const VerdictLimits& limits);

/// Whether the 95 % interval of the difference of the image means excludes 0.
bool excludes_zero(const TileComparison& comparison);

/// Whether the tiles in which one run holds over half of the variance are more numerous on one side than on the other,
/// by more than 1 % of the tiles and by more than two. That side has not met its rare bright samples often enough: a
/// tile in which they are missing is too dark, and a t-test fails it far more often than alpha. The test of the image
/// mean, which sums the rare samples of all tiles, remains valid. Equal tails on both sides do no harm: the difference
/// is symmetric.
bool lopsided_tails(const TileComparison& comparison);

/// Whether the darker side's runs have a positive skewness above 0.4 and above 2.5 of its standard errors. Then rare
/// bright samples hold much of the mean, and a side that has met too few of them is too dark: t-tests fail such sides
/// up to a hundred times as often as alpha, always as too dark. The skewness of the brighter side is not considered.
/// False with common seeds: in a difference the bright samples of the two sides have opposite signs.
bool unmet_tail(const TileComparison& comparison);

/// Whether the standard error of the darker side's skewness is above 0.65: fewer than 15 runs of one tile, or fewer
/// than four runs of two tiles of equal variance. Then unmet_tail may miss a tail, and so few runs may be close
/// together by chance. False with common seeds.
bool unknown_tail(const TileComparison& comparison);

/// Whether one run holds over half of the image mean's variance on a side, and more than the largest of as many normal
/// runs would once in 10^4 (Grubbs). Then the variance is known too poorly for an interval. False with common seeds,
/// where one path that parts may make up all of a very small variance.
bool single_run_decides(const TileComparison& comparison);

/// Image mean, Fisher's combination and the least tile of every pair go through Holm's procedure together, so one false
/// FAIL among all pairs has probability alpha at most. PASS needs has_power, FAIL does not. With lopsided_tails,
/// only the image mean can FAIL, and tiles alone give INCONCLUSIVE. With unmet_tail or unknown_tail, a difference is
/// INCONCLUSIVE; only tiles without noise that differ FAIL. With single_run_decides there is no PASS.
std::vector<PairVerdict> judge(std::span<const TileComparison> comparisons, const VerdictLimits& limits);

/// FAIL if any verdict is FAIL, else INCONCLUSIVE if any is, else PASS.
Verdict overall(std::span<const PairVerdict> verdicts);

}  // namespace diptych::core
