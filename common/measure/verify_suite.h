// One run of `verify`: all sides rendered, all pairs compared, in one stage or two.
#pragma once

#include <optional>

#include "stats/bias_verdict.h"
#include "measure/verify_sides.h"

namespace diptych::core {

struct PairResult {
    PairName names;
    TileComparison comparison;
    PairVerdict verdict;
    double alpha = 0;  // family-wise, of the stage that decided
    std::uint32_t spp = 0;
    std::uint32_t spp_b = 0;
    std::uint32_t seed_a = 0;  // of the first run of the frame, or of its first chain; see SeedPlan for the others
    std::uint32_t seed_b = 0;
    std::uint64_t chain_step = 0;  // from the seed of a run's chain to that of its next
    int stage = 1;
    std::string device_a;
    std::string device_b;
};

struct SuiteResult {
    std::vector<PairResult> pairs;
    TileGrid grid;
    std::uint32_t seed = 0;
    double seconds = 0;
    bool interrupted = false;  // then only the pairs are here whose sides were rendered
};

/// Nothing where `cancel` came before a pair was rendered; else the pairs that were. With fresh seeds, pairs that fail are rendered again with other seeds
/// and four times the samples, and fail only below a tenth of alpha. With a time limit, the samples of all runs are
/// doubled until every pair has power or the time is used up; when to stop depends on the noise alone, not on the
/// difference, so it does not bend the p-values.
std::optional<SuiteResult> run_suite(const VerifySettings& settings, const VerifySubject& subject,
                                     const std::vector<PairName>& pairs, std::uint32_t seed,
                                     const std::atomic<bool>& cancel, const RunHook& hook);

}  // namespace diptych::core
