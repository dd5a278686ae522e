#include "measure/verify_suite.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <future>
#include <system_error>

#include "clock.h"

namespace diptych::core {

namespace {

constexpr std::uint32_t first_spp = 4;         // where time is the limit
constexpr double least_extension = 0.2;        // of the samples so far: less is not worth it
constexpr std::uint32_t second_stage_spp = 4;  // times the first's
constexpr double second_stage_alpha = 0.1;     // likewise
constexpr double first_stage_time = 0.2;       // leaves the second stage its four times as many samples
constexpr std::uint32_t most_spp = 1U << 30U;

struct Stage {
    std::vector<PairName> pairs;
    std::uint32_t seed = 0;  // the user's
    SeedPurpose purpose = SeedPurpose::verify;
    std::uint32_t spp = 0;
    std::uint32_t reference_spp = 0;
    double seconds = 0;  // 0: spp is what counts
    VerdictLimits limits;
    int number = 1;
};

/// On a thread of its own; where none can be started, when its result is asked for.
std::future<bool> in_parallel(const std::function<bool()>& work) {
    try {
        return std::async(std::launch::async, work);
    } catch (const std::system_error&) {
        return std::async(std::launch::deferred, work);
    }
}

/// A side of several pairs is rendered once. Candidates and references are apart, even where they bear one name.
struct Sides {
    struct Wanted {
        SideName name;
        bool is_reference = false;
        std::vector<std::uint32_t> frames;
    };
    std::vector<Wanted> wanted;
    std::vector<VerifySide> all;                               // parallel to wanted
    std::vector<std::pair<std::size_t, std::size_t>> of_pair;  // indices
    std::uint64_t chain_step = 0;

    Sides(const Stage& stage, const VerifySubject& subject, const VerifySettings& settings) {
        for (const PairName& pair : stage.pairs) {
            const std::size_t a = want(pair.a, false, pair.frame);
            of_pair.emplace_back(a, want(pair.b, true, pair.frame));
        }
        const auto count = static_cast<std::uint32_t>(settings.common_seeds ? 1 : wanted.size());
        const SeedPlan seeds(stage.seed, stage.purpose, count, settings.runs);
        chain_step = seeds.part_step();
        for (Wanted& side : wanted) {
            std::sort(side.frames.begin(), side.frames.end());
            side.frames.erase(std::unique(side.frames.begin(), side.frames.end()), side.frames.end());
            const auto place = static_cast<std::uint32_t>(settings.common_seeds ? 0 : all.size());
            all.emplace_back(side.name, subject, settings, side.frames, seeds, place,
                             side.is_reference ? stage.reference_spp : stage.spp);
        }
    }

    std::size_t want(const SideName& name, bool is_reference, std::optional<std::uint32_t> frame) {
        auto at = std::find_if(wanted.begin(), wanted.end(), [&](const Wanted& side) {
            return side.name == name && side.is_reference == is_reference;
        });
        if (at == wanted.end()) {
            at = wanted.insert(at, {name, is_reference, {}});
        }
        if (frame) {
            at->frames.push_back(*frame);
        }
        return static_cast<std::size_t>(at - wanted.begin());
    }

    /// A graphics device renders its sides while the processor renders the others, until one of them has failed. False
    /// where `cancel` came in between.
    bool extend(std::uint32_t samples, std::uint32_t reference_samples, const std::atomic<bool>& cancel,
                const RunHook& hook) {
        std::atomic<bool> failed = false;
        struct Abandoned {};
        const RunHook before_run = [&](const SideName& side, std::uint32_t run) {
            if (failed) {
                throw Abandoned();
            }
            hook(side, run);
        };
        const auto extend_those = [&](bool on_vulkan) {
            try {
                for (std::size_t i = 0; i < all.size(); ++i) {
                    if ((wanted[i].name.backend == "vulkan") == on_vulkan &&
                        !all[i].extend(wanted[i].is_reference ? reference_samples : samples, cancel, before_run)) {
                        return false;
                    }
                }
            } catch (const Abandoned&) {
                return false;  // what the other thread threw is reported
            } catch (...) {
                failed = true;
                throw;
            }
            return true;
        };
        std::future<bool> on_vulkan = in_parallel([&] { return extend_those(true); });
        const bool others = extend_those(false);
        return on_vulkan.get() && others;
    }
};

std::vector<TileComparison> compare(const std::vector<PairName>& pairs, const Sides& sides, bool common_seeds,
                                    const TileTestOptions& of_test = {}) {
    std::vector<TileComparison> comparisons;
    const auto test = common_seeds ? compare_common_runs : compare_runs;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const auto [a, b] = sides.of_pair[i];
        const auto frame = pairs[i].frame;
        comparisons.push_back(test(sides.all[a].runs(frame), sides.all[b].runs(frame), of_test));
    }
    return comparisons;
}

/// Samples to add next; 0 where the time would not suffice for enough of them.
std::uint32_t next_extension(std::uint32_t spp, double rendering_seconds, double seconds_left) {
    const double share = std::min(1.0, seconds_left / std::max(rendering_seconds, 1e-9));
    return share < least_extension || spp >= most_spp ? 0 : static_cast<std::uint32_t>(std::floor(spp * share));
}

/// The next number of samples that chains of so many samples a frame can give.
std::uint32_t whole_chains(std::uint32_t samples, const VerifySettings& settings) {
    return (samples + settings.frame_spp - 1) / settings.frame_spp * settings.frame_spp;
}

bool render_stage(const Stage& stage, Sides& sides, const VerifySettings& settings, const std::atomic<bool>& cancel,
                  const RunHook& hook) {
    const double start = now_seconds();
    if (stage.seconds == 0) {
        return sides.extend(stage.spp, stage.reference_spp, cancel, hook);
    }
    std::uint32_t samples = whole_chains(first_spp, settings);
    while (samples > 0) {
        if (!sides.extend(samples, samples, cancel, hook)) {
            return false;
        }
        const double rendering = now_seconds() - start;
        const std::vector<TileComparison> comparisons =
            compare(stage.pairs, sides, settings.common_seeds, {.resamplings = 0});  // for their widths
        if (std::all_of(comparisons.begin(), comparisons.end(),
                        [&](const TileComparison& c) { return has_power(c, stage.limits); })) {
            break;
        }
        const double left = start + stage.seconds - now_seconds();
        samples = whole_chains(next_extension(sides.all.front().spp(), rendering, left), settings);
        for (const VerifySide& side : sides.all) {  // as many as there are seeds for
            samples = static_cast<std::uint32_t>(std::min<std::uint64_t>(samples, side.most_spp() - side.spp()));
        }
    }
    return true;
}

struct StageResult {
    std::vector<PairResult> pairs;
    std::vector<std::size_t> places;  // of them, among the stage's pairs
    bool interrupted = false;         // then those pairs are missing of which a side has no samples
};

/// Leaves the pairs of which both sides have samples.
void keep_rendered(Stage& stage, Sides& sides, std::vector<std::size_t>& places) {
    std::vector<PairName> pairs;
    std::vector<std::pair<std::size_t, std::size_t>> of_pair;
    for (std::size_t i = 0; i < stage.pairs.size(); ++i) {
        const auto [a, b] = sides.of_pair[i];
        if (sides.all[a].spp() > 0 && sides.all[b].spp() > 0) {
            pairs.push_back(stage.pairs[i]);
            of_pair.emplace_back(a, b);
            places.push_back(i);
        }
    }
    stage.pairs = std::move(pairs);
    sides.of_pair = std::move(of_pair);
}

StageResult run_stage(Stage stage, const VerifySubject& subject, const VerifySettings& settings,
                      const std::atomic<bool>& cancel, const RunHook& hook) {
    Sides sides(stage, subject, settings);
    StageResult stage_result;
    stage_result.interrupted = !render_stage(stage, sides, settings, cancel, hook);
    keep_rendered(stage, sides, stage_result.places);
    const std::vector<TileComparison> comparisons = compare(stage.pairs, sides, settings.common_seeds);
    const std::vector<PairVerdict> verdicts = judge(comparisons, stage.limits);
    for (std::size_t i = 0; i < stage.pairs.size(); ++i) {
        const auto [a, b] = sides.of_pair[i];
        PairResult result;
        result.names = stage.pairs[i];
        result.comparison = comparisons[i];
        result.verdict = verdicts[i];
        result.alpha = stage.limits.alpha;
        result.spp = sides.all[a].spp();
        result.spp_b = sides.all[b].spp();
        result.seed_a = sides.all[a].first_seed(result.names.frame);
        result.seed_b = sides.all[b].first_seed(result.names.frame);
        result.chain_step = sides.chain_step;
        result.stage = stage.number;
        result.device_a = sides.all[a].device();
        result.device_b = sides.all[b].device();
        const std::uint64_t nonfinite = sides.all[a].nonfinite() + sides.all[b].nonfinite();
        if (nonfinite > 0) {
            result.verdict.verdict = Verdict::fail;
            result.verdict.reason = fmt::format("{} samples were not finite, or negative, and dropped", nonfinite);
        }
        stage_result.pairs.push_back(result);
    }
    return stage_result;
}

/// The pairs that failed get another chance, with seeds of their own; what they say then stands. Without it there is no
/// verdict on them. False where `cancel` came in between.
bool run_second_stage(Stage stage, const VerifySubject& subject, const VerifySettings& settings,
                      const std::atomic<bool>& cancel, const RunHook& hook, std::vector<PairResult>& results) {
    std::vector<std::size_t> failed;
    stage.pairs.clear();
    for (std::size_t i = 0; i < results.size(); ++i) {
        if (results[i].verdict.verdict == Verdict::fail) {
            failed.push_back(i);
            stage.pairs.push_back(results[i].names);
            results[i].verdict.verdict = Verdict::inconclusive;
            results[i].verdict.reason = "interrupted before it was tested again";
        }
    }
    if (failed.empty()) {
        return true;
    }
    stage.number = 2;
    stage.purpose = SeedPurpose::verify_again;
    stage.spp = second_stage_spp * results[failed.front()].spp;
    stage.reference_spp = second_stage_spp * results[failed.front()].spp_b;
    stage.seconds = 0;
    stage.limits.alpha *= second_stage_alpha;
    const StageResult again = run_stage(stage, subject, settings, cancel, hook);
    for (std::size_t i = 0; i < again.pairs.size(); ++i) {
        results[failed[again.places[i]]] = again.pairs[i];
    }
    return !again.interrupted;
}

}  // namespace

std::optional<SuiteResult> run_suite(const VerifySettings& settings, const VerifySubject& subject,
                                     const std::vector<PairName>& pairs, std::uint32_t seed,
                                     const std::atomic<bool>& cancel, const RunHook& hook) {
    const double start = now_seconds();
    Stage stage;
    stage.pairs = pairs;
    stage.seed = seed;
    stage.spp = settings.spp;
    stage.reference_spp = settings.against_spp > 0 ? settings.against_spp : settings.spp;
    stage.seconds = settings.seconds * (settings.fresh_seeds ? first_stage_time : 1);
    stage.limits.alpha = settings.alpha;
    stage.limits.max_half_width = settings.max_half_width;
    stage.limits.max_tile_half_width = settings.max_tile_half_width;
    StageResult first = run_stage(stage, subject, settings, cancel, hook);
    if (first.pairs.empty()) {
        return std::nullopt;
    }
    SuiteResult suite;
    suite.interrupted = first.interrupted || (settings.fresh_seeds && !run_second_stage(stage, subject, settings, cancel,
                                                                                       hook, first.pairs));
    suite.pairs = std::move(first.pairs);
    suite.grid = tile_grid(subject.request.settings.width, subject.request.settings.height, settings.tile);
    suite.seed = seed;
    suite.seconds = now_seconds() - start;
    return suite;
}

}  // namespace diptych::core
