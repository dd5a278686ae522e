// Verification by random scenes: scenes are drawn one after another and judged together. Those that fail are shrunk.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "random_scene/judge.h"

namespace diptych::core {

enum class RandomMotion { even_seeds, moving, still };

struct RandomSuiteSettings {
    std::uint32_t scenes = 1;
    std::uint64_t first_seed = 0;  // of the scenes, which have consecutive ones
    RandomMotion motion = RandomMotion::even_seeds;
    bool shrink = true;
    JudgeOptions judge;
};

/// A scene on which two sides differ.
struct RandomFailure {
    RandomPair pair;    // the least likely of the scene's
    RandomScene scene;  // the smallest that fails, with the pair's integrator
};

/// A scene that could not be rendered at all, though everything in it is allowed.
struct RandomRefusal {
    RandomScene scene;
    std::string reason;
};

struct RandomSuite {
    std::uint32_t scenes = 0;  // judged
    std::vector<RandomPair> pairs;
    std::vector<RandomFailure> failures;
    std::vector<RandomRefusal> refusals;
    bool interrupted = false;  // while scenes were judged, or made smaller
    ReachedPower oracle_power;
    ReachedPower common_power;
    Verdict verdict = Verdict::inconclusive;
    double seconds = 0;
};

struct RandomSuiteHooks {
    std::function<void(std::uint64_t seed)> begin;             // before each scene
    std::function<void(const std::string& message)> warn;      // about scenes that could not be made smaller
};

/// The scene of that seed.
RandomScene random_scene_of(std::uint64_t seed, RandomMotion motion);

/// Scenes are read back from files in a temporary folder, as a user's are. A scene that cannot be read or rendered is a
/// finding. Throws NoDevice and DeviceLost.
RandomSuite judge_random_scenes(const RandomSuiteSettings& settings, const Renderers& renderers,
                                const std::atomic<bool>& cancel, const RandomSuiteHooks& hooks);

}  // namespace diptych::core
