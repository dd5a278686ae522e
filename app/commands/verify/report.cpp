#include "commands/verify/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "build_info.h"
#include "stats/kolmogorov_smirnov.h"
#include "commands/arguments/typed_command.h"
#include "console/output.h"

namespace diptych::core::app {

namespace {

std::vector<PairVerdict> verdicts_of(const SuiteResult& suite) {
    std::vector<PairVerdict> verdicts;
    for (const PairResult& pair : suite.pairs) {
        verdicts.push_back(pair.verdict);
    }
    return verdicts;
}

double tile_ks_p(const TileComparison& comparison) {
    std::vector<double> p;
    for (const TileOutcome& tile : comparison.tiles) {
        if (tile.state == ChannelState::tested) {
            p.push_back(tile.p);
        }
    }
    return kolmogorov_smirnov_uniform(p).p;
}

/// In whole chains, no fewer than there were.
double more_of(double spp, double factor, const VerifyOptions& options) {
    return std::ceil(spp * factor / options.frame_spp) * options.frame_spp;
}

std::string samples_text(double spp, double spp_b, bool spread) {
    return fmt::format("--spp {:.0f}", spp) + (spread ? fmt::format(" --against-spp {:.0f}", spp_b) : "");
}

double wanted_runs(const PairResult& pair, const VerifyOptions& options) {
    return std::ceil(options.runs * pair.verdict.more_runs);
}

std::string runs_text(double runs, const VerifyOptions& options) {
    return runs > options.runs ? fmt::format(" --runs {:.0f}", runs) : "";
}

std::string advice(const PairResult& pair, const VerifyOptions& options) {
    return ": try " +
           samples_text(more_of(pair.spp, pair.verdict.more_samples, options),
                        more_of(pair.spp_b, pair.verdict.more_samples, options), pair.spp != pair.spp_b) +
           runs_text(wanted_runs(pair, options), options);
}

/// Characters of the first column.
int name_width(const VerifyOptions& options) {
    return options.frames.empty() ? 28 : 39;
}

void print_pair(const PairResult& pair, const VerifyOptions& options) {
    const TileComparison& c = pair.comparison;
    print_result(
        "{:<{}} {:>11} {:>9.4f}  [{:>8.4f}, {:>8.4f}] {:>8.4f} {:>8.4f} {:>5.0f}% {:>9.2g} {:>9.2g} {:>9.2g}  {}\n",
        text_of(pair.names), name_width(options),
        pair.spp == pair.spp_b ? fmt::format("{}", pair.spp) : fmt::format("{}:{}", pair.spp, pair.spp_b),
        c.bias_percent, c.ci95_percent[0], c.ci95_percent[1], c.half_width_percent, pair.verdict.min_detectable_percent,
        100 * c.resolved_share, c.global_p, c.fisher_p, c.min_p, name_of(pair.verdict.verdict));
    if (pair.verdict.verdict != Verdict::pass) {
        print_result("    {}{}\n", pair.verdict.reason,
                     pair.verdict.verdict == Verdict::inconclusive ? advice(pair, options) : "");
    }
}

}  // namespace

Verdict verdict_of(const SuiteResult& suite) {
    return overall(verdicts_of(suite));
}

std::string next_command(const VerifyOptions& options, const SuiteResult& suite) {
    double spp = 0;
    double spp_b = 0;
    double runs = options.runs;
    bool spread = false;
    bool seen = false;
    for (const PairResult& pair : suite.pairs) {
        if (pair.verdict.verdict == Verdict::inconclusive) {
            spp = std::max(spp, more_of(pair.spp, pair.verdict.more_samples, options));
            spp_b = std::max(spp_b, more_of(pair.spp_b, pair.verdict.more_samples, options));
            runs = std::max(runs, wanted_runs(pair, options));
            spread = spread || pair.spp != pair.spp_b;
            seen = seen || excludes_zero(pair.comparison) || pair.verdict.adjusted_p <= options.alpha;
        }
    }
    if (spp == 0) {
        return "";
    }
    std::vector<std::string> replaced = {"--spp", "--against-spp", "--time"};
    std::string instead = samples_text(spp, spp_b, spread) + runs_text(runs, options);
    if (runs > options.runs) {
        replaced.emplace_back("--runs");
    }
    if (seen) {  // the same runs again would find the same difference again
        replaced.emplace_back("--seed");
        instead += fmt::format(" --seed {}", suite.seed + 1);
    }
    return typed_command(*options.command, replaced, instead);
}

void print_suite(const VerifyOptions& options, const SuiteResult& suite) {
    const RenderSettings& settings = options.arguments.request.settings;
    print_result("{} at {}x{}: {} runs per side{}, {} tiles of {}x{}, seed {}, {:.1f} s\n",
                 options.arguments.request.scene, settings.width, settings.height, options.runs,
                 options.common_seeds ? " with common seeds" : "",
                 suite.grid.columns * suite.grid.rows, options.tile, options.tile, suite.seed, suite.seconds);
    if (!options.frames.empty()) {
        const RenderRequest& request = options.arguments.request;
        print_result("Sequence from {:g} s on, {:g} frames per second{}; restir has {} sample{} per frame\n",
                     request.start, request.fps,
                     request.orbit != 0 ? fmt::format(", camera turns by {:g} degrees per frame", request.orbit) : "",
                     options.frame_spp, options.frame_spp == 1 ? "" : "s");
    }
    print_result("{:<{}} {:>11} {:>9}  {:^20} {:>8} {:>8} {:>6} {:>9} {:>9} {:>9}  verdict\n", "pair",
                 name_width(options), "spp", "bias %", "95 % interval", "+-", "detects", "tiles", "image p", "Fisher p",
                 "least p");
    for (const PairResult& pair : suite.pairs) {
        print_pair(pair, options);
    }
    print_result(
        "\"+-\" is the 95 % half-width of the image mean, of the channel where it is widest. \"tiles\" is the share of "
        "tiles with a half-width of at most 1 %.\n"
        "PASS needs \"+-\" <= {:.3g} %, and a half-width of at most {:.3g} % in half of the tiles.\n",
        options.max_half_width, options.max_tile_half_width);
    print_result(
        "FAIL has a family-wise alpha of {:.2g}{}. A bias of \"detects\" % of the image mean is found with probability "
        "0.9.\n",
        options.alpha,
        options.fresh_seeds
            ? fmt::format(", and of {:.2g} in a second test with other seeds and four times the samples",
                          options.alpha / 10)
            : "");
    if (options.fresh_seeds) {
        print_result("To repeat: --fresh-seeds --seed {}\n", suite.seed);
    }
    if (const std::string next = next_command(options, suite); !next.empty()) {
        print_result("To tell: {}\n", next);
    }
    print_result("{}\n", name_of(verdict_of(suite)));
}

nlohmann::ordered_json suite_to_json(const VerifyOptions& options, const SuiteResult& suite) {
    const RenderSettings& settings = options.arguments.request.settings;
    nlohmann::ordered_json json;
    json["verdict"] = name_of(verdict_of(suite));
    json["scene"] = options.arguments.request.scene;
    json["width"] = settings.width;
    json["height"] = settings.height;
    json["max_depth"] = settings.max_depth;
    json["runs"] = options.runs;
    json["tile"] = options.tile;
    json["alpha"] = options.alpha;
    json["max_half_width_percent"] = options.max_half_width;
    json["max_tile_half_width_percent"] = options.max_tile_half_width;
    json["fresh_seeds"] = options.fresh_seeds;
    json["common_seeds"] = options.common_seeds;
    if (!options.frames.empty()) {
        json["fps"] = options.arguments.request.fps;
        json["start"] = options.arguments.request.start;
        json["orbit"] = options.arguments.request.orbit;
        json["frame_spp"] = options.frame_spp;
    }
    json["seed"] = suite.seed;
    json["seconds"] = suite.seconds;
    json["interrupted"] = suite.interrupted;
    json["commit"] = build_info::commit;
    if (const std::string next = next_command(options, suite); !next.empty()) {
        json["next_command"] = next;
    }
    json["pairs"] = nlohmann::ordered_json::array();
    for (const PairResult& pair : suite.pairs) {
        const TileComparison& c = pair.comparison;
        nlohmann::ordered_json entry;
        entry["a"] = text_of(pair.names.a);
        entry["b"] = text_of(pair.names.b);
        if (pair.names.frame) {
            entry["frame"] = *pair.names.frame;
            entry["time"] = options.arguments.request.start + *pair.names.frame / options.arguments.request.fps;
        }
        entry["spp"] = pair.spp;
        entry["spp_b"] = pair.spp_b;
        entry["mean_a"] = c.mean_a;
        entry["mean_b"] = c.mean_b;
        entry["bias_percent"] = c.bias_percent;
        entry["ci95_percent"] = c.ci95_percent;
        entry["channel_bias_percent"] = c.channel_bias_percent;
        entry["half_width_percent"] = c.half_width_percent;
        entry["min_detectable_percent"] = pair.verdict.min_detectable_percent;
        entry["global_p"] = c.global_p;
        entry["fisher_p"] = c.fisher_p;
        entry["min_p"] = c.min_p;
        entry["adjusted_p"] = pair.verdict.adjusted_p;
        entry["tile_ks_p"] = tile_ks_p(c);
        entry["tiles"] = c.tiles.size();
        entry["tiles_tested"] = c.tested;
        entry["tiles_unequal"] = c.unequal;
        entry["tiles_heavy"] = {c.heavy_a, c.heavy_b};
        entry["skewness"] = {c.tail_a.skewness, c.tail_b.skewness};
        entry["largest_run_share"] = {c.tail_a.largest_share, c.tail_b.largest_share};
        entry["tile_half_width_percent"] = c.tile_half_width_percent;
        entry["tiles_within_1_percent"] = c.resolved_share;
        entry["stage"] = pair.stage;
        entry["stage_alpha"] = pair.alpha;
        entry["seed_a"] = pair.seed_a;
        entry["seed_b"] = pair.seed_b;
        entry["chain_seed_step"] = pair.chain_step;
        entry["device_a"] = pair.device_a;
        entry["device_b"] = pair.device_b;
        entry["verdict"] = name_of(pair.verdict.verdict);
        entry["reason"] = pair.verdict.reason;
        json["pairs"].push_back(entry);
    }
    return json;
}

}  // namespace diptych::core::app
