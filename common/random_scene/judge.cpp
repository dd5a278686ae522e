#include "random_scene/judge.h"

#include <algorithm>
#include <map>

#include "random_scene/judge_side.h"
#include "random_scene/scene_files.h"
#include "settings/names.h"

namespace diptych::core {

namespace {

constexpr std::uint32_t oracle_seeds = 0x40000000U;  // apart from the panels', as the second stage's from the first's
constexpr std::uint32_t path_seeds = 0x20000000U;    // where it is a reference
constexpr std::uint32_t second_stage_seeds = 0x80000000U;
constexpr std::uint32_t third_stage_seeds = 0x10000000U;

/// Everything of one scene that its comparisons share.
struct Judged {
    const RandomScene& random;
    const Scene scene;
    const Renderers& renderers;
    const JudgeOptions& options;

    /// Of a scene that moves: one, for integrators that have no use for the others.
    std::vector<std::uint32_t> one_frame() const {
        return random.frames == 0 ? std::vector<std::uint32_t>{} : std::vector{std::uint32_t(random.seed % random.frames)};
    }

    std::vector<std::uint32_t> frames(Integrator integrator) const {
        if (!resamples(integrator)) {
            return one_frame();
        }
        std::vector<std::uint32_t> out;
        for (std::uint32_t frame = 0; frame < random.frames; ++frame) {
            out.push_back(frame);
        }
        return out;
    }

    std::unique_ptr<RandomSide> side(const MakeRenderer& make, Integrator integrator,
                                     const std::vector<std::uint32_t>& frames, std::uint32_t seed) const {
        RenderSettings settings = random.settings;
        settings.integrator = integrator;
        return std::make_unique<RandomSide>(random, scene, make, settings, frames, options.runs, seed);
    }
};

bool is_below(const RandomPair& pair, double p) {
    const TileComparison& c = pair.comparison;
    return std::min({c.global_p, c.fisher_p, c.local_p}) < p || c.unequal > 0;
}

/// One pair a frame, or one at rest.
template <typename Compare>
std::vector<RandomPair> make_pairs(const Judged& judged, Integrator integrator, const RandomSide& side,
                                   const std::string& backend, const RandomSide& reference,
                                   const std::string& reference_name, Compare&& compare) {
    const std::vector<std::uint32_t> frames = judged.frames(integrator);
    std::vector<RandomPair> pairs(std::max<std::size_t>(frames.size(), 1));
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        RandomPair& pair = pairs[i];
        pair.scene = judged.random.seed;
        pair.integrator = integrator;
        pair.side = backend + "/" + name_of(integrator);
        pair.reference = reference_name;
        pair.comparison = compare(side.runs(i), reference.runs(i));
        pair.spp = side.spp();
        pair.nonfinite = side.nonfinite() + reference.nonfinite();
        if (!frames.empty()) {
            pair.frame = frames[i];
        }
    }
    return pairs;
}

/// What the CPU under an integrator is compared with, at the same frames. The oracle takes about as long as four
/// integrators, so it judges `path` at one frame, and `path` those that resample at all.
struct Reference {
    std::string name;
    std::unique_ptr<RandomSide> side;
};

bool by_path(const Judged& judged, Integrator integrator) {
    return judged.random.frames > 0 && resamples(integrator);
}

Reference make_reference(const Judged& judged, Integrator integrator, std::uint32_t seed) {
    const std::vector<std::uint32_t> frames = judged.frames(integrator);
    if (by_path(judged, integrator)) {
        return {"cpu/path", judged.side(judged.renderers.cpu, Integrator::path, frames, seed + path_seeds)};
    }
    return {"oracle/mis", judged.side(judged.renderers.oracle, Integrator::path, frames, seed + oracle_seeds)};
}

/// The reference may have more samples already. The number of samples follows from the noise alone, so it hardly bends
/// the p-values.
std::vector<RandomPair> against_reference(const Judged& judged, Integrator integrator, const Reference& reference,
                                          std::uint32_t seed, std::uint32_t times) {
    const JudgeOptions& options = judged.options;
    const std::vector<std::uint32_t> frames = judged.frames(integrator);
    const std::size_t count = std::max<std::size_t>(frames.size(), 1);
    const auto cpu = judged.side(judged.renderers.cpu, integrator, frames, seed);
    for (std::uint32_t spp = options.first_spp * times;; spp *= 2) {
        cpu->extend_to(spp);
        reference.side->extend_to(spp);
        bool enough = true;
        for (std::size_t i = 0; i < count && enough; ++i) {
            const TileComparison now = compare_runs(cpu->runs(i), reference.side->runs(i), {.resamplings = 0});
            enough = now.half_width_percent <= options.half_width_percent;
        }
        if (enough || 2 * spp > options.most_spp * times) {
            break;
        }
    }
    return make_pairs(judged, integrator, *cpu, "cpu", *reference.side, reference.name,
                      [](const auto& a, const auto& b) { return compare_runs(a, b); });
}

std::vector<RandomPair> against_cpu(const Judged& judged, Integrator integrator, std::uint32_t seed,
                                    std::uint32_t spp) {
    const std::vector<std::uint32_t> frames = judged.frames(integrator);
    const auto vulkan = judged.side(judged.renderers.vulkan, integrator, frames, seed);
    const auto cpu = judged.side(judged.renderers.cpu, integrator, frames, seed);
    vulkan->extend_to(spp);
    cpu->extend_to(spp);
    return make_pairs(judged, integrator, *vulkan, "vulkan", *cpu, std::string("cpu/") + name_of(integrator),
                      [](const auto& a, const auto& b) { return compare_common_runs(a, b); });
}

/// After a stage with a p-value below `begins_below`.
struct Stage {
    double begins_below;
    std::uint32_t seeds;
    std::uint32_t times;  // the first stage's samples
};

/// The frames of one chain are rendered together, but each is judged by its own stages.
template <typename Compare>
std::vector<RandomPair> in_stages(const JudgeOptions& options, Compare&& compare) {
    std::vector<RandomPair> pairs = compare(options.seed, 1U);
    const Stage stages[] = {{options.suspicious_p, second_stage_seeds, options.second_stage},
                            {options.grave_p, third_stage_seeds, options.third_stage}};
    int before = 1;
    for (const Stage& stage : stages) {
        const auto goes_on = [&](const RandomPair& pair) {
            return pair.stage == before && is_below(pair, stage.begins_below);
        };
        if (stage.times <= 1 || std::none_of(pairs.begin(), pairs.end(), goes_on)) {
            break;
        }
        const std::vector<RandomPair> again = compare(options.seed + stage.seeds, stage.times);
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            if (goes_on(pairs[i])) {
                const std::uint64_t nonfinite = pairs[i].nonfinite;
                pairs[i] = again[i];
                pairs[i].nonfinite += nonfinite;
                pairs[i].stage = before + 1;
            }
        }
        ++before;
    }
    return pairs;
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
    std::map<std::pair<bool, std::uint32_t>, Reference> references;  // of each kind and stage
    for (const Integrator integrator : options.integrators) {
        if (renderers.oracle) {
            add(in_stages(options, [&](std::uint32_t seed, std::uint32_t times) {
                Reference& reference = references[{by_path(judged, integrator), seed}];
                if (!reference.side) {
                    reference = make_reference(judged, integrator, seed);
                }
                return against_reference(judged, integrator, reference, seed, times);
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

ReachedPower reached_power(const std::vector<RandomPair>& pairs, const std::string& backend,
                           double half_width_percent) {
    ReachedPower power;
    std::vector<double> widths;
    for (const RandomPair& pair : pairs) {
        if (pair.side.starts_with(backend)) {
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

Verdict verdict_of(const std::vector<RandomPair>& pairs, const JudgeOptions& options) {
    constexpr double wanted_share = 0.9;
    bool known = true;
    for (const RandomPair& pair : pairs) {
        if (pair.verdict.verdict == Verdict::fail) {
            return Verdict::fail;
        }
        known = known && pair.verdict.adjusted_p > options.alpha;
    }
    for (const char* backend : {"cpu", "vulkan"}) {
        known = known && reached_power(pairs, backend, options.half_width_percent).reached_share >= wanted_share;
    }
    return known ? Verdict::pass : Verdict::inconclusive;
}

}  // namespace diptych::core
