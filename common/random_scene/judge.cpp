#include "random_scene/judge.h"

#include <algorithm>
#include <map>

#include "random_scene/scene_files.h"
#include "render/film_tiles.h"
#include "render/settings_names.h"

namespace diptych {

namespace {

constexpr int tile = 8;
constexpr std::uint32_t oracle_seeds = 0x40000000U;  // apart from the panels', as the second stage's from the first's
constexpr std::uint32_t second_stage_seeds = 0x80000000U;

/// A renderer's runs, each with a seed of its own.
class Side {
public:
    Side(std::unique_ptr<Renderer> renderer, std::uint32_t runs, std::uint32_t first_seed)
        : renderer_(std::move(renderer)), first_seed_(first_seed), runs_(runs) {}

    /// Adds samples to every run until it has so many.
    void extend_to(std::uint32_t spp) {
        const std::atomic<bool> cancel{false};
        for (std::size_t run = 0; run < runs_.size() && spp > spp_; ++run) {
            renderer_->restart(first_seed_ + std::uint32_t(run));
            renderer_->render(spp_, spp - spp_, cancel);
            const Film film = renderer_->film();
            nonfinite_ += film_totals(film).nonfinite;
            const RunMeans means = tile_means(film, tile);
            runs_[run] = spp_ == 0 ? means : merge_means(runs_[run], spp_, means, spp - spp_);
        }
        spp_ = std::max(spp, spp_);
    }

    const std::vector<RunMeans>& runs() const { return runs_; }
    std::uint32_t spp() const { return spp_; }
    std::uint64_t nonfinite() const { return nonfinite_; }

private:
    std::unique_ptr<Renderer> renderer_;
    std::uint32_t first_seed_;
    std::vector<RunMeans> runs_;
    std::uint32_t spp_ = 0;
    std::uint64_t nonfinite_ = 0;
};

/// Everything of one scene that its comparisons share.
struct Judged {
    const RandomScene& random;
    const Scene scene;
    const Renderers& renderers;
    const JudgeOptions& options;

    RenderSettings settings(Integrator integrator) const {
        RenderSettings out = random.settings;
        out.integrator = integrator;
        return out;
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

Side oracle_side(const Judged& judged, std::uint32_t seed) {
    const RenderSettings settings = judged.settings(Integrator::path);
    const PackedScene packed = pack_scene(judged.scene, settings);  // which the oracle does not read
    return {judged.renderers.oracle(judged.scene, packed, settings), judged.options.runs, seed + oracle_seeds};
}

/// The CPU under one integrator and the oracle, which may have more samples already. The number of samples follows from
/// the noise alone, so it does not bend the p-values.
RandomPair against_oracle(const Judged& judged, Integrator integrator, Side& oracle, std::uint32_t seed,
                          std::uint32_t times) {
    const JudgeOptions& options = judged.options;
    const RenderSettings settings = judged.settings(integrator);
    const PackedScene packed = pack_scene(judged.scene, settings);
    Side cpu(judged.renderers.cpu(judged.scene, packed, settings), options.runs, seed);
    RandomPair pair = new_pair(judged, integrator, "cpu", "oracle/mis");
    for (std::uint32_t spp = options.first_spp * times;; spp *= 2) {
        cpu.extend_to(spp);
        oracle.extend_to(spp);
        const bool last = 2 * spp > options.most_spp * times;
        if (last || compare_runs(cpu.runs(), oracle.runs(), {.resamplings = 0}).half_width_percent <=
                        options.half_width_percent) {
            break;
        }
    }
    pair.comparison = compare_runs(cpu.runs(), oracle.runs());
    pair.spp = cpu.spp();
    pair.nonfinite = cpu.nonfinite() + oracle.nonfinite();
    return pair;
}

RandomPair against_cpu(const Judged& judged, Integrator integrator, std::uint32_t seed, std::uint32_t spp) {
    const RenderSettings settings = judged.settings(integrator);
    const PackedScene packed = pack_scene(judged.scene, settings);
    Side vulkan(judged.renderers.vulkan(judged.scene, packed, settings), judged.options.runs, seed);
    Side cpu(judged.renderers.cpu(judged.scene, packed, settings), judged.options.runs, seed);
    vulkan.extend_to(spp);
    cpu.extend_to(spp);
    RandomPair pair = new_pair(judged, integrator, "vulkan", std::string("cpu/") + name_of(integrator));
    pair.comparison = compare_common_runs(vulkan.runs(), cpu.runs());
    pair.spp = vulkan.spp();
    pair.nonfinite = vulkan.nonfinite() + cpu.nonfinite();
    return pair;
}

/// One stage, or two.
template <typename Compare>
RandomPair in_stages(const JudgeOptions& options, Compare&& compare) {
    RandomPair first = compare(options.seed, 1U);
    if (!suspicious(first, options)) {
        return first;
    }
    RandomPair second = compare(options.seed + second_stage_seeds, options.second_stage);
    second.nonfinite += first.nonfinite;
    second.stage = 2;
    return second;
}

}  // namespace

std::vector<RandomPair> compare_scene(const RandomScene& random, const std::filesystem::path& path,
                                      const Renderers& renderers, const JudgeOptions& options) {
    write_random_scene(random, path);
    const Judged judged{random, read_random_scene(random, path), renderers, options};
    std::vector<RandomPair> pairs;
    std::map<std::uint32_t, Side> oracles;  // of each stage
    for (const Integrator integrator : options.integrators) {
        if (renderers.oracle) {
            pairs.push_back(in_stages(options, [&](std::uint32_t seed, std::uint32_t times) {
                const auto oracle = oracles.find(seed);
                Side& side = oracle != oracles.end() ? oracle->second
                                                     : oracles.emplace(seed, oracle_side(judged, seed)).first->second;
                return against_oracle(judged, integrator, side, seed, times);
            }));
        }
        if (renderers.vulkan) {
            pairs.push_back(in_stages(options, [&](std::uint32_t seed, std::uint32_t times) {
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
