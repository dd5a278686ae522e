#include "random_scene/random_suite.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "clock.h"
#include "error.h"
#include "random_scene/shrink.h"

namespace diptych::core {

namespace {

constexpr double shrinking_p = 1e-5;                     // below which a smaller scene counts as failing too
constexpr std::uint32_t confirming_seeds = 0x08000000U;  // apart from those of all stages (judge.cpp)

/// A folder for the scenes' files, deleted with this object.
class ScratchFolder {
public:
    ScratchFolder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "diptych-random-XXXXXX").string();
        if (::mkdtemp(pattern.data()) == nullptr) {
            throw Error(pattern + ": " + std::generic_category().message(errno));
        }
        path_ = pattern;
    }
    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    std::filesystem::path file(const std::string& name) const { return path_ / name; }

private:
    std::filesystem::path path_;
};

/// What one suite's steps share.
struct Suite {
    const RandomSuiteSettings& settings;
    const Renderers& renderers;
    const std::atomic<bool>& cancel;
    const RandomSuiteHooks& hooks;
    ScratchFolder scratch;
};

/// Whether the failing pair fails on this scene too.
bool fails_alike(const Suite& suite, const RandomScene& random, const RandomPair& failed, JudgeOptions options) {
    options.integrators = {failed.integrator};
    Renderers wanted = suite.renderers;
    (failed.side.starts_with("cpu") ? wanted.vulkan : wanted.oracle) = {};
    try {
        const std::vector<RandomPair> pairs =
            compare_scene(random, suite.scratch.file("smaller.gltf"), wanted, options);
        return std::any_of(pairs.begin(), pairs.end(), [&](const RandomPair& pair) {
            const TileComparison& c = pair.comparison;
            const bool differs = std::min({c.global_p, c.fisher_p, c.local_p}) < shrinking_p || c.unequal > 0;
            return pair.frame == failed.frame && (failed.nonfinite > 0 ? pair.nonfinite > 0 : differs);
        });
    } catch (const Error&) {
        return false;  // too small to be a scene
    }
}

/// The smallest scene that fails. Trials are many and have few samples, so what they chose is judged once more by all
/// stages, with other seeds. If it does not fail then, the scene stays whole.
RandomScene shrink_failing(const Suite& suite, const RandomScene& whole, const RandomPair& failed) {
    JudgeOptions quickly = suite.settings.judge;
    quickly.third_stage = 1;
    RandomScene smaller = shrink(
        whole, [&](const RandomScene& trial) { return !suite.cancel && fails_alike(suite, trial, failed, quickly); });
    JudgeOptions again = suite.settings.judge;
    again.seed += confirming_seeds;
    if (fails_alike(suite, smaller, failed, again)) {
        return smaller;
    }
    if (suite.hooks.warn) {
        suite.hooks.warn(fmt::format("seed {}: a smaller scene failed, but not again with other seeds: written whole",
                                     failed.scene));
    }
    return whole;
}

RandomFailure failure_of(const Suite& suite, const RandomPair& failed) {
    RandomScene random = random_scene_of(failed.scene, suite.settings.motion);
    random.settings.integrator = failed.integrator;
    if (suite.settings.shrink && !suite.cancel) {
        random = shrink_failing(suite, random, failed);
    }
    return {failed, std::move(random)};
}

/// One failure a scene: its least likely pair.
std::vector<RandomPair> failing_scenes(const std::vector<RandomPair>& pairs) {
    std::vector<RandomPair> out;
    for (const RandomPair& pair : pairs) {
        if (pair.verdict.verdict != Verdict::fail) {
            continue;
        }
        if (out.empty() || out.back().scene != pair.scene) {
            out.push_back(pair);
        } else if (pair.verdict.adjusted_p < out.back().verdict.adjusted_p) {
            out.back() = pair;
        }
    }
    return out;
}

/// A scene that cannot be read or rendered is a finding; a device that is missing or lost ends the run.
void judge_scene(const Suite& suite, std::uint64_t seed, RandomSuite& result) {
    const RandomScene scene = random_scene_of(seed, suite.settings.motion);
    try {
        const std::vector<RandomPair> pairs =
            compare_scene(scene, suite.scratch.file("scene.gltf"), suite.renderers, suite.settings.judge);
        result.pairs.insert(result.pairs.end(), pairs.begin(), pairs.end());
    } catch (const NoDevice&) {
        throw;
    } catch (const DeviceLost&) {
        throw;
    } catch (const Error& error) {
        result.refusals.push_back({scene, error.what()});
    }
}

}  // namespace

RandomScene random_scene_of(std::uint64_t seed, RandomMotion motion) {
    const bool moves = motion == RandomMotion::moving || (motion == RandomMotion::even_seeds && seed % 2 == 0);
    return moves ? make_moving_random_scene(seed) : make_random_scene(seed);
}

RandomSuite judge_random_scenes(const RandomSuiteSettings& settings, const Renderers& renderers,
                                const std::atomic<bool>& cancel, const RandomSuiteHooks& hooks) {
    const Suite suite{settings, renderers, cancel, hooks, {}};
    const Stopwatch watch;
    RandomSuite result;
    for (; result.scenes < settings.scenes && !cancel; ++result.scenes) {
        const std::uint64_t seed = settings.first_seed + result.scenes;
        if (hooks.begin) {
            hooks.begin(seed);
        }
        judge_scene(suite, seed, result);
    }
    judge_all(result.pairs, settings.judge);
    for (const RandomPair& failed : failing_scenes(result.pairs)) {
        result.failures.push_back(failure_of(suite, failed));
    }
    result.interrupted = cancel;
    result.oracle_power = reached_power(result.pairs, "cpu", settings.judge.half_width_percent);
    result.common_power = reached_power(result.pairs, "vulkan", settings.judge.half_width_percent);
    result.verdict = result.refusals.empty() ? verdict_of(result.pairs, settings.judge) : Verdict::fail;
    result.seconds = watch.seconds();
    return result;
}

}  // namespace diptych::core
