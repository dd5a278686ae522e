#include "random_scene/judge.h"

#include <algorithm>
#include <map>

#include "random_scene/judge_side.h"
#include "random_scene/scene_files.h"
#include "render/settings_names.h"

namespace diptych {

namespace {

constexpr std::uint32_t oracle_seeds = 0x40000000U;  // apart from the panels', as the second stage's from the first's
constexpr std::uint32_t second_stage_seeds = 0x80000000U;

/// Everything of one scene that its comparisons share.
struct Judged {
    const RandomScene& random;
    const Scene scene;
    const Renderers& renderers;
    const JudgeOptions& options;

    /// The frames judged: all under integrators that resample, which may look back, and one under the others, which
    /// cannot; none of a scene at rest.
    std::vector<std::uint32_t> frames(Integrator integrator) const {
        if (random.frames == 0) {
            return {};
        }
        if (!resamples(integrator)) {
            return {std::uint32_t((random.seed + std::uint64_t(integrator)) % random.frames)};
        }
        return all_frames();
    }

    std::vector<std::uint32_t> all_frames() const {
        std::vector<std::uint32_t> out;
        for (std::uint32_t frame = 0; frame < random.frames; ++frame) {
            out.push_back(frame);
        }
        return out;
    }

    std::unique_ptr<RandomSide> side(const Renderers::Make& make, Integrator integrator,
                                     const std::vector<std::uint32_t>& frames, std::uint32_t seed) const {
        RenderSettings settings = random.settings;
        settings.integrator = integrator;
        return std::make_unique<RandomSide>(random, scene, make, settings, frames, options.runs, seed);
    }
};

bool suspicious(const RandomPair& pair, const JudgeOptions& options) {
    const TileComparison& c = pair.comparison;
    return std::min({c.global_p, c.fisher_p, c.local_p}) < options.suspicious_p || c.unequal > 0;
}

RandomPair new_pair(const Judged& judged, Integrator integrator, const char* side, const std::string& reference) {
    RandomPair pair;
    pair.scene = judged.random.seed;
    pair.integrator = integrator;
    pair.side = std::string(side) + "/" + name_of(integrator);
    pair.reference = reference;
    return pair;
}

/// Where a side that judges all frames has this one.
std::size_t place_in_all(const std::vector<std::uint32_t>& frames, std::size_t i) {
    return frames.empty() ? 0 : frames[i];
}

/// The CPU under one integrator and the oracle, which judges all frames and may have more samples already. The number
/// of samples follows from the noise alone, so it does not bend the p-values. One pair a frame, or one at rest.
std::vector<RandomPair> against_oracle(const Judged& judged, Integrator integrator, RandomSide& oracle,
                                       std::uint32_t seed, std::uint32_t times) {
    const JudgeOptions& options = judged.options;
    const std::vector<std::uint32_t> frames = judged.frames(integrator);
    const std::size_t count = std::max<std::size_t>(frames.size(), 1);
    const auto cpu = judged.side(judged.renderers.cpu, integrator, frames, seed);
    const auto compare = [&](std::size_t i, const TileTestOptions& with) {
        return compare_runs(cpu->runs(i), oracle.runs(place_in_all(frames, i)), with);
    };
    for (std::uint32_t spp = options.first_spp * times;; spp *= 2) {
        cpu->extend_to(spp);
        oracle.extend_to(spp);
        bool enough = true;
        for (std::size_t i = 0; i < count && enough; ++i) {
            enough = compare(i, {.resamplings = 0}).half_width_percent <= options.half_width_percent;
        }
        if (enough || 2 * spp > options.most_spp * times) {
            break;
        }
    }
    std::vector<RandomPair> pairs;
    for (std::size_t i = 0; i < count; ++i) {
        RandomPair pair = new_pair(judged, integrator, "cpu", "oracle/mis");
        pair.comparison = compare(i, {});
        pair.spp = cpu->spp();
        pair.nonfinite = cpu->nonfinite() + oracle.nonfinite();
        if (!frames.empty()) {
            pair.frame = frames[i];
        }
        pairs.push_back(pair);
    }
    return pairs;
}

std::vector<RandomPair> against_cpu(const Judged& judged, Integrator integrator, std::uint32_t seed,
                                    std::uint32_t spp) {
    const std::vector<std::uint32_t> frames = judged.frames(integrator);
    const auto vulkan = judged.side(judged.renderers.vulkan, integrator, frames, seed);
    const auto cpu = judged.side(judged.renderers.cpu, integrator, frames, seed);
    vulkan->extend_to(spp);
    cpu->extend_to(spp);
    std::vector<RandomPair> pairs;
    for (std::size_t i = 0; i < std::max<std::size_t>(frames.size(), 1); ++i) {
        RandomPair pair = new_pair(judged, integrator, "vulkan", std::string("cpu/") + name_of(integrator));
        pair.comparison = compare_common_runs(vulkan->runs(i), cpu->runs(i));
        pair.spp = vulkan->spp();
        pair.nonfinite = vulkan->nonfinite() + cpu->nonfinite();
        if (!frames.empty()) {
            pair.frame = frames[i];
        }
        pairs.push_back(pair);
    }
    return pairs;
}

/// One stage, or two. The frames of one chain are rendered together, but each is judged by its own stages.
template <typename Compare>
std::vector<RandomPair> in_stages(const JudgeOptions& options, Compare&& compare) {
    std::vector<RandomPair> first = compare(options.seed, 1U);
    const auto doubtful = [&](const RandomPair& pair) { return suspicious(pair, options); };
    if (std::none_of(first.begin(), first.end(), doubtful)) {
        return first;
    }
    const std::vector<RandomPair> second = compare(options.seed + second_stage_seeds, options.second_stage);
    for (std::size_t i = 0; i < first.size(); ++i) {
        if (doubtful(first[i])) {
            const std::uint64_t nonfinite = first[i].nonfinite;
            first[i] = second[i];
            first[i].nonfinite += nonfinite;
            first[i].stage = 2;
        }
    }
    return first;
}

}  // namespace

std::string text_of(const RandomPair& pair) {
    const std::string frame = pair.frame ? ", frame " + std::to_string(*pair.frame) : "";
    return pair.side + " - " + pair.reference + frame;
}

std::vector<RandomPair> compare_scene(const RandomScene& random, const std::filesystem::path& path,
                                      const Renderers& renderers, const JudgeOptions& options) {
    write_random_scene(random, path);
    const Judged judged{random, read_random_scene(random, path), renderers, options};
    std::vector<RandomPair> pairs;
    const auto add = [&pairs](const std::vector<RandomPair>& more) { pairs.insert(pairs.end(), more.begin(), more.end()); };
    std::map<std::uint32_t, std::unique_ptr<RandomSide>> oracles;  // of each stage
    for (const Integrator integrator : options.integrators) {
        if (renderers.oracle) {
            add(in_stages(options, [&](std::uint32_t seed, std::uint32_t times) {
                std::unique_ptr<RandomSide>& oracle = oracles[seed];
                if (!oracle) {
                    oracle = judged.side(renderers.oracle, Integrator::path, judged.all_frames(), seed + oracle_seeds);
                }
                return against_oracle(judged, integrator, *oracle, seed, times);
            }));
        }
        if (renderers.vulkan) {
            add(in_stages(options, [&](std::uint32_t seed, std::uint32_t times) {
                return against_cpu(judged, integrator, seed, options.common_spp * times);
            }));
        }
    }
    return pairs;
}

void judge_all(std::vector<RandomPair>& pairs, const JudgeOptions& options) {
    std::vector<TileComparison> comparisons;
    for (const RandomPair& pair : pairs) {
        comparisons.push_back(pair.comparison);
    }
    VerdictLimits limits;
    limits.alpha = options.alpha;
    limits.max_half_width = options.half_width_percent;
    limits.max_tile_half_width = 100;  // tiles of so small a picture are not held to a width of their own
    const std::vector<PairVerdict> verdicts = judge(comparisons, limits);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        pairs[i].verdict = verdicts[i];
        if (pairs[i].nonfinite > 0) {
            pairs[i].verdict.verdict = Verdict::fail;
            pairs[i].verdict.reason = "samples were not finite, or negative, and dropped";
        }
    }
}

ReachedPower reached_power(const std::vector<RandomPair>& pairs, const std::string& reference,
                           double half_width_percent) {
    ReachedPower power;
    std::vector<double> widths;
    for (const RandomPair& pair : pairs) {
        if (pair.reference.starts_with(reference)) {
            widths.push_back(pair.comparison.half_width_percent);
        }
    }
    power.pairs = widths.size();
    if (widths.empty()) {
        return power;
    }
    std::sort(widths.begin(), widths.end());
    power.median = widths[widths.size() / 2];
    power.worst = widths.back();
    const auto reached = std::upper_bound(widths.begin(), widths.end(), half_width_percent) - widths.begin();
    power.reached_share = double(reached) / double(widths.size());
    return power;
}

Verdict verdict_of(const std::vector<RandomPair>& pairs, double half_width_percent) {
    constexpr double wanted_share = 0.9;
    for (const RandomPair& pair : pairs) {
        if (pair.verdict.verdict == Verdict::fail) {
            return Verdict::fail;
        }
    }
    for (const char* reference : {"oracle", "cpu"}) {
        if (reached_power(pairs, reference, half_width_percent).reached_share < wanted_share) {
            return Verdict::inconclusive;
        }
    }
    return Verdict::pass;
}

}  // namespace diptych
