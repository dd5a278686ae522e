// Tests on random scenes that all renderers have one expectation.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "random_scene/random_scene.h"
#include "render/session.h"
#include "stats/bias_verdict.h"

namespace diptych::core {

/// Renderers by name. An empty function leaves that renderer out.
struct Renderers {
    MakeRenderer cpu;
    MakeRenderer oracle;  // the CPU is compared with it, or with its own `path`, by seeds of their own
    MakeRenderer vulkan;  // compared with the CPU, by common seeds
};

struct JudgeOptions {
    std::vector<Integrator> integrators{Integrator::brdf, Integrator::direct, Integrator::path, Integrator::ris,
                                        Integrator::restir};
    std::uint32_t runs = 16;         // a side
    std::uint32_t first_spp = 8;     // of a run; doubled until the half-width is reached
    std::uint32_t most_spp = 256;
    std::uint32_t common_spp = 4;    // of a run where both sides have its seed
    double half_width_percent = 1;   // of the image mean (95 %), at which no more samples are taken
    double alpha = 1e-3;             // chance of a false FAIL, over all comparisons together
    double suspicious_p = 0.01;      // a pair with a test below is judged by a second stage alone
    std::uint32_t second_stage = 4;  // as many times the samples, with other seeds
    double grave_p = 1e-4;           // and with one below in the second stage, by a third alone
    std::uint32_t third_stage = 16;  // as many times the first's; 1 and less leaves it out
    std::uint32_t seed = 1;          // of the renders
};

/// One comparison of two sides on one scene.
struct RandomPair {
    std::uint64_t scene = 0;  // its seed
    std::string side;         // "cpu/path"
    std::string reference;    // "oracle/mis", "cpu/path"
    std::optional<std::uint32_t> frame{};  // of a scene that moves
    Integrator integrator = Integrator::path;
    TileComparison comparison;
    std::uint32_t spp = 0;        // of each run of `side`
    std::uint64_t nonfinite = 0;  // samples dropped
    int stage = 1;                // that decides
    PairVerdict verdict;          // judge_all's to set
};

/// "cpu/restir - oracle/mis, frame 3".
std::string text_of(const RandomPair& pair);

/// Renders the scene, read from its files, on every side and compares. Where it moves, `ris` and `restir` are compared
/// with `path` at every frame, and the integrators that look back to none with the oracle at one of them. What looks
/// unlikely is rendered again with seeds of its own, and the last comparison stands alone, so that its p-values mean what
/// they say; its samples are many, so that rare bright ones are among them and the runs' means are near to normal.
std::vector<RandomPair> compare_scene(const RandomScene& random, const std::filesystem::path& path,
                                      const Renderers& renderers, const JudgeOptions& options);

/// Holm's procedure over all comparisons of all scenes.
void judge_all(std::vector<RandomPair>& pairs, const JudgeOptions& options);

/// How narrow the intervals of the image means are, percent.
struct ReachedPower {
    std::size_t pairs = 0;
    double median = 0;
    double worst = 0;
    double reached_share = 1;  // of the pairs, those at most half_width_percent wide
};

/// Of the pairs whose side is that backend: "cpu" has seeds of its own, "vulkan" its reference's. Empty: of all.
ReachedPower reached_power(const std::vector<RandomPair>& pairs, const std::string& backend,
                           double half_width_percent);

/// FAIL where a pair fails. INCONCLUSIVE where none does but one differs by its p-value and its runs are too skewed to
/// believe that, or where fewer than nine tenths of a backend's pairs are known well enough. Else PASS.
Verdict verdict_of(const std::vector<RandomPair>& pairs, const JudgeOptions& options);

}  // namespace diptych::core
