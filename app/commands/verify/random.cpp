#include "commands/verify/random.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "clock.h"
#include "session/make_renderer.h"
#include "commands/arguments/recommended_arguments.h"
#include "commands/command.h"
#include "error.h"
#include "console/interrupt.h"
#include "random_scene/judge.h"
#include "random_scene/scene_files.h"
#include "random_scene/shrink.h"
#include "settings/names.h"
#include "console/option_names.h"
#include "console/report.h"
#include "console/step_line.h"
#include "commands/verify/report.h"

namespace diptych::core::app {

namespace {

constexpr double default_half_width = 1;  // percent
constexpr double shrinking_p = 1e-5;      // below which a smaller scene counts as failing too
constexpr std::uint32_t confirming_seeds = 0x08000000U;  // apart from those of all stages (judge.cpp)

/// Options that go with --random; all others belong to the scene, or to tests of one scene.
constexpr const char* allowed[] = {"--random",         "--seed",      "--backends", "--integrators",
                                   "--alpha",          "--runs",      "--device",   "--threads",
                                   "--max-half-width", "--validation", "--json",     "--output",
                                   "--require-pass",   "--shrink",    "--moving",   "--still"};

bool given(const VerifyOptions& options, const char* name) {
    return options.command->get_option(name)->count() > 0;
}

void check_options(const VerifyOptions& options) {
    for (const CLI::Option* option : options.command->get_options()) {
        const auto names_it = [&](const char* name) { return option->check_name(name); };
        if (option->count() > 0 && std::none_of(std::begin(allowed), std::end(allowed), names_it)) {
            throw Error(fmt::format("{}: does not go with --random, which draws the scenes and their settings",
                                    option->get_name()));
        }
    }
    for (const std::string& backend : options.backends) {
        if (backend != "cpu" && backend != "vulkan") {
            throw Error(fmt::format("--backends {}: --random compares cpu and vulkan", backend));
        }
    }
}

Renderers make_renderers(const VerifyOptions& options, const std::vector<std::string>& backends) {
    const auto maker = [&options](const std::string& backend) {
        return [&options, backend](const Scene& scene, const PackedScene& packed, const RenderSettings& settings) {
            RenderRequest request = options.arguments.request;
            request.backend = backend;
            request.settings = settings;
            return make_renderer(scene, packed, request);
        };
    };
    const auto wants = [&](const char* name) {
        return std::find(backends.begin(), backends.end(), name) != backends.end();
    };
    Renderers out;
    out.cpu = maker("cpu");
    if (wants("cpu")) {
        out.oracle = maker("oracle");
    }
    if (wants("vulkan")) {
        out.vulkan = maker("vulkan");
    }
    return out;
}

JudgeOptions judge_options(const VerifyOptions& options) {
    JudgeOptions out;
    out.alpha = options.alpha;
    out.half_width_percent = given(options, "--max-half-width") ? options.max_half_width : default_half_width;
    if (given(options, "--runs")) {
        out.runs = options.runs;
    }
    if (given(options, "--integrators")) {
        out.integrators.clear();
        for (const std::string& name : options.integrators) {
            out.integrators.push_back(integrator_from_name(name));
        }
    }
    return out;
}

/// A folder for the scenes' files, gone with this.
class ScratchFolder {
public:
    ScratchFolder()
        : path_(std::filesystem::temp_directory_path() / fmt::format("diptych-random-{}", getpid())) {
        std::filesystem::create_directories(path_);
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

struct Failure {
    RandomPair pair;
    std::string file;     // the smallest scene that fails
    std::string command;  // that renders it
    std::string verify;   // that judges the whole scene again
};

struct Refusal {
    std::uint64_t scene = 0;
    std::string file;
    std::string reason;
};

/// Every second scene moves unless one kind is asked for.
RandomScene scene_of(std::uint64_t seed, const VerifyOptions& options) {
    const bool moves = options.moving || (!options.still && seed % 2 == 0);
    return moves ? make_moving_random_scene(seed) : make_random_scene(seed);
}

/// Whether the failing pair fails on this scene too.
bool fails_alike(const RandomScene& random, const RandomPair& failed, const Renderers& renderers, JudgeOptions options,
                 const std::filesystem::path& scratch) {
    options.integrators = {failed.integrator};
    Renderers wanted = renderers;
    (failed.side.starts_with("cpu") ? wanted.vulkan : wanted.oracle) = {};
    try {
        const std::vector<RandomPair> pairs = compare_scene(random, scratch, wanted, options);
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
/// stages, with other seeds; if it does not fail then, the scene stays whole.
RandomScene shrink_failing(const RandomScene& whole, const RandomPair& failed, const Renderers& renderers,
                           const JudgeOptions& judge_with, const ScratchFolder& scratch,
                           const InterruptGuard& interrupt) {
    JudgeOptions quickly = judge_with;
    quickly.third_stage = 1;
    const std::filesystem::path file = scratch.file("smaller.gltf");
    const RandomScene smaller = shrink(whole, [&](const RandomScene& trial) {
        return !interrupt.requested() && fails_alike(trial, failed, renderers, quickly, file);
    });
    JudgeOptions again = judge_with;
    again.seed += confirming_seeds;
    if (fails_alike(smaller, failed, renderers, again, file)) {
        return smaller;
    }
    report_warning(fmt::format("seed {}: a smaller scene failed, but not again with other seeds: written whole",
                               failed.scene));
    return whole;
}

std::filesystem::path failing_file(const VerifyOptions& options, const std::string& name) {
    const std::filesystem::path folder = options.output.empty() ? "." : options.output;
    return (folder / (name + ".gltf")).lexically_normal();
}

Failure write_failure(const RandomPair& failed, const VerifyOptions& options, const Renderers& renderers,
                      const JudgeOptions& judge_with, const ScratchFolder& scratch, const InterruptGuard& interrupt) {
    RandomScene random = scene_of(failed.scene, options);
    random.settings.integrator = failed.integrator;
    const bool moves = random.frames > 0;
    if (options.shrink && !interrupt.requested()) {
        random = shrink_failing(random, failed, renderers, judge_with, scratch, interrupt);
    }
    const std::string name =
        fmt::format("random-{}{}-{}", failed.scene, moves ? "-moving" : "", name_of(failed.integrator));
    const std::filesystem::path file = failing_file(options, name);
    write_random_scene(random, file);
    const std::string arguments = recommended_arguments(random, file);
    return {failed, file.string(), fmt::format("diptych render {} {} -o {}.exr", file.string(), arguments, name),
            fmt::format("diptych verify --random 1 --seed {} {} --integrators {} --backends {} --max-half-width {}",
                        failed.scene, moves ? "--moving" : "--still", name_of(failed.integrator),
                        failed.side.starts_with("cpu") ? "cpu" : "vulkan", judge_with.half_width_percent)};
}

/// A scene that could not be rendered at all, though everything in it is allowed.
Refusal write_refusal(std::uint64_t seed, const VerifyOptions& options, const Error& error) {
    const std::filesystem::path file = failing_file(options, fmt::format("random-{}-refused", seed));
    write_random_scene(scene_of(seed, options), file);
    return {seed, file.string(), with_option_names(error.what())};
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

void print_failure(const Failure& failure) {
    const RandomPair& pair = failure.pair;
    const TileComparison& c = pair.comparison;
    fmt::print("seed {}: {}: {:.3g} % [{:.3g}, {:.3g}], adjusted p {:.2g}: {}\n  {}: {}\n", pair.scene, text_of(pair),
               c.bias_percent, c.ci95_percent[0], c.ci95_percent[1], pair.verdict.adjusted_p,
               pair.verdict.reason, failure.file, failure.command);
    fmt::print("  whole: {}\n", failure.verify);
}

nlohmann::ordered_json pair_json(const RandomPair& pair) {
    const TileComparison& c = pair.comparison;
    const nlohmann::ordered_json frame = pair.frame ? nlohmann::ordered_json(*pair.frame) : nlohmann::ordered_json();
    return {{"seed", pair.scene},
            {"frame", frame},
            {"a", pair.side},
            {"b", pair.reference},
            {"spp", pair.spp},
            {"stage", pair.stage},
            {"samples_dropped", pair.nonfinite},
            {"bias_percent", c.bias_percent},
            {"ci95_percent", c.ci95_percent},
            {"half_width_percent", c.half_width_percent},
            {"global_p", c.global_p},
            {"fisher_p", c.fisher_p},
            {"local_p", c.local_p},
            {"adjusted_p", pair.verdict.adjusted_p},
            {"verdict", name_of(pair.verdict.verdict)},
            {"reason", pair.verdict.reason}};
}

nlohmann::ordered_json failure_json(const Failure& failure) {
    nlohmann::ordered_json json = pair_json(failure.pair);
    json["output"] = failure.file;
    json["command"] = failure.command;
    json["verify"] = failure.verify;
    return json;
}

struct RandomReport {
    std::uint32_t scenes = 0;
    std::vector<RandomPair> pairs;
    std::vector<Failure> failures;
    std::vector<Refusal> refusals;
    bool interrupted = false;
    ReachedPower oracle_power, common_power;
    Verdict verdict = Verdict::inconclusive;
    double seconds = 0;
};

/// A scene that cannot be read or rendered is a finding; a device that is missing or lost ends the run.
void judge_scene(std::uint64_t seed, const VerifyOptions& options, const Renderers& renderers,
                 const JudgeOptions& judged_with, const ScratchFolder& scratch, RandomReport& report) {
    try {
        const std::vector<RandomPair> pairs =
            compare_scene(scene_of(seed, options), scratch.file("scene.gltf"), renderers, judged_with);
        report.pairs.insert(report.pairs.end(), pairs.begin(), pairs.end());
    } catch (const NoDevice&) {
        throw;
    } catch (const DeviceLost&) {
        throw;
    } catch (const Error& error) {
        report.refusals.push_back(write_refusal(seed, options, error));
    }
}

void print_power(const char* what, const ReachedPower& power, double wanted) {
    if (power.pairs > 0) {
        fmt::print("{}: {} comparisons, image means known to {:.3g} % (median; worst {:.3g} %), {:.0f} % of them to {} %\n",
                   what, power.pairs, power.median, power.worst, 100 * power.reached_share, wanted);
    }
}

nlohmann::ordered_json power_json(const ReachedPower& power) {
    return {{"comparisons", power.pairs},
            {"median_half_width_percent", power.median},
            {"worst_half_width_percent", power.worst},
            {"reached_share", power.reached_share}};
}

void print_report(const VerifyOptions& options, const JudgeOptions& judged_with, const RandomReport& report) {
    if (options.json) {
        nlohmann::ordered_json json{{"scenes", report.scenes},
                                    {"asked", options.random},
                                    {"interrupted", report.interrupted},
                                    {"moving", options.moving ? "all" : options.still ? "none" : "even seeds"},
                                    {"seed", options.seed},
                                    {"verdict", name_of(report.verdict)},
                                    {"alpha", judged_with.alpha},
                                    {"cpu_against_oracle", power_json(report.oracle_power)},
                                    {"vulkan_against_cpu", power_json(report.common_power)},
                                    {"refusals", nlohmann::ordered_json::array()},
                                    {"failures", nlohmann::ordered_json::array()},
                                    {"pairs", nlohmann::ordered_json::array()},
                                    {"seconds", report.seconds}};
        for (const Refusal& refusal : report.refusals) {
            json["refusals"].push_back({{"seed", refusal.scene}, {"output", refusal.file}, {"reason", refusal.reason}});
        }
        for (const Failure& failure : report.failures) {
            json["failures"].push_back(failure_json(failure));
        }
        for (const RandomPair& pair : report.pairs) {
            json["pairs"].push_back(pair_json(pair));
        }
        print_json(json);
        return;
    }
    for (const Refusal& refusal : report.refusals) {
        fmt::print("seed {}: refused: {}\n  {}\n", refusal.scene, refusal.reason, refusal.file);
    }
    for (const Failure& failure : report.failures) {
        print_failure(failure);
    }
    fmt::print("{} scenes from seed {}, {:.0f} s{}\n", report.scenes, options.seed, report.seconds,
               report.interrupted ? fmt::format("; interrupted; asked for {}", options.random) : "");
    print_power("cpu - oracle or path", report.oracle_power, judged_with.half_width_percent);
    print_power("vulkan - cpu, common seeds", report.common_power, judged_with.half_width_percent);
    fmt::print("{}\n", name_of(report.verdict));
}

}  // namespace

void add_random_option(CLI::App& command, VerifyOptions& options) {
    command
        .add_option("--random", options.random,
                    "Instead of a scene: so many scenes drawn at random, from --seed on, each under five integrators: cpu "
                    "against the oracle, vulkan against cpu from the same random numbers. Those of even seeds move, and "
                    "ris and restir are judged at each of five frames. One that fails is shrunk and written, into -o")
        ->check(CLI::Range(1U, 1U << 30U));
    CLI::Option* moving =
        command.add_flag("--moving", options.moving, "Of --random: let all scenes move, not every second one");
    command.add_flag("--still", options.still, "Of --random: let none move")->excludes(moving);
    command.add_flag("--shrink,!--no-shrink", options.shrink,
                     "Of --random: make scenes that fail smaller before they are written; on by default");
}

int verify_random(const VerifyOptions& options) {
    check_options(options);
    if (!options.output.empty()) {
        prepare_folder(options.output);
    }
    const std::vector<std::string> backends =
        given(options, "--backends") || DIPTYCH_VULKAN == 0 ? options.backends : std::vector<std::string>{"cpu", "vulkan"};
    const Renderers renderers = make_renderers(options, backends);
    const JudgeOptions judged_with = judge_options(options);
    const ScratchFolder scratch;
    const Stopwatch watch;
    RandomReport report;
    const InterruptGuard interrupt;
    {
        StepLine line(static_cast<int>(options.random));
        for (; report.scenes < options.random && !interrupt.requested(); ++report.scenes) {
            const std::uint64_t seed = std::uint64_t(options.seed) + report.scenes;
            line.begin(fmt::format("seed {}", seed));
            judge_scene(seed, options, renderers, judged_with, scratch, report);
        }
    }
    judge_all(report.pairs, judged_with);
    for (const RandomPair& failed : failing_scenes(report.pairs)) {
        report.failures.push_back(write_failure(failed, options, renderers, judged_with, scratch, interrupt));
    }
    report.interrupted = interrupt.requested();  // while scenes were judged, or made smaller
    report.oracle_power = reached_power(report.pairs, "cpu", judged_with.half_width_percent);
    report.common_power = reached_power(report.pairs, "vulkan", judged_with.half_width_percent);
    report.verdict = report.refusals.empty() ? verdict_of(report.pairs, judged_with) : Verdict::fail;
    report.seconds = watch.seconds();
    print_report(options, judged_with, report);
    if (report.interrupted) {
        return exit_interrupted;
    }
    const bool fails = report.verdict == Verdict::fail || (options.require_pass && report.verdict != Verdict::pass);
    return fails ? exit_check_failed : exit_done;
}

}  // namespace diptych::core::app
