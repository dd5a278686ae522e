#include "commands/verify/random.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "session/make_renderer.h"
#include "commands/arguments/recommended_arguments.h"
#include "commands/command.h"
#include "error.h"
#include "console/output.h"
#include "console/interrupt.h"
#include "random_scene/random_suite.h"
#include "random_scene/scene_files.h"
#include "settings/names.h"
#include "console/option_names.h"
#include "console/report.h"
#include "console/step_line.h"
#include "commands/verify/report.h"

namespace diptych::core::app {

namespace {

constexpr double default_half_width = 1;  // percent

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
            throw Error(fmt::format("{}: does not work with --random, which draws the scenes and their settings",
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

RandomSuiteSettings suite_settings(const VerifyOptions& options) {
    RandomSuiteSettings out;
    out.scenes = options.random;
    out.first_seed = options.seed;
    out.motion = options.moving  ? RandomMotion::moving
                 : options.still ? RandomMotion::still
                                 : RandomMotion::even_seeds;
    out.shrink = options.shrink;
    out.judge = judge_options(options);
    return out;
}

/// A finding as files, and the commands that show it.
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

std::string write_finding(const VerifyOptions& options, const std::string& name, const RandomScene& scene) {
    const std::filesystem::path folder = options.output.empty() ? "." : options.output;
    const std::filesystem::path file = (folder / (name + ".gltf")).lexically_normal();
    write_random_scene(scene, file);
    return file.string();
}

Failure write_failure(const RandomFailure& failure, const VerifyOptions& options, double half_width_percent) {
    const RandomPair& failed = failure.pair;
    const bool moves = failure.scene.frames > 0;
    const std::string name =
        fmt::format("random-{}{}-{}", failed.scene, moves ? "-moving" : "", name_of(failed.integrator));
    const std::string file = write_finding(options, name, failure.scene);
    const std::string arguments = recommended_arguments(failure.scene, file);
    return {failed, file, fmt::format("diptych render {} {} -o {}.exr", file, arguments, name),
            fmt::format("diptych verify --random 1 --seed {} {} --integrators {} --backends {} --max-half-width {}",
                        failed.scene, moves ? "--moving" : "--still", name_of(failed.integrator),
                        failed.side.starts_with("cpu") ? "cpu" : "vulkan", half_width_percent)};
}

Refusal write_refusal(const RandomRefusal& refusal, const VerifyOptions& options) {
    const std::uint64_t seed = refusal.scene.seed;
    return {seed, write_finding(options, fmt::format("random-{}-refused", seed), refusal.scene),
            with_option_names(refusal.reason)};
}

void print_failure(const Failure& failure) {
    const RandomPair& pair = failure.pair;
    const TileComparison& c = pair.comparison;
    print_result("seed {}: {}: {:.3g} % [{:.3g}, {:.3g}], adjusted p {:.2g}: {}\n  {}: {}\n", pair.scene, text_of(pair),
                 c.bias_percent, c.ci95_percent[0], c.ci95_percent[1], pair.verdict.adjusted_p,
                 pair.verdict.reason, failure.file, failure.command);
    print_result("  to test the whole scene: {}\n", failure.verify);
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

/// The findings as they were written.
struct Findings {
    std::vector<Failure> failures;
    std::vector<Refusal> refusals;
};

void print_power(const char* what, const ReachedPower& power, double wanted) {
    if (power.pairs > 0) {
        print_result("{}: {} comparisons; 95 % half-width of the image mean: median {:.3g} %, worst {:.3g} %; "
                     "{:.0f} % are within {} %\n",
                     what, power.pairs, power.median, power.worst, 100 * power.reached_share, wanted);
    }
}

nlohmann::ordered_json power_json(const ReachedPower& power) {
    return {{"comparisons", power.pairs},
            {"median_half_width_percent", power.median},
            {"worst_half_width_percent", power.worst},
            {"reached_share", power.reached_share}};
}

void print_suite(const VerifyOptions& options, const JudgeOptions& judged_with, const RandomSuite& report,
                 const Findings& findings) {
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
        for (const Refusal& refusal : findings.refusals) {
            json["refusals"].push_back({{"seed", refusal.scene}, {"output", refusal.file}, {"reason", refusal.reason}});
        }
        for (const Failure& failure : findings.failures) {
            json["failures"].push_back(failure_json(failure));
        }
        for (const RandomPair& pair : report.pairs) {
            json["pairs"].push_back(pair_json(pair));
        }
        print_json(json);
        return;
    }
    for (const Refusal& refusal : findings.refusals) {
        print_result("seed {}: refused: {}\n  {}\n", refusal.scene, refusal.reason, refusal.file);
    }
    for (const Failure& failure : findings.failures) {
        print_failure(failure);
    }
    print_result("{} scenes from seed {}, {:.0f} s{}\n", report.scenes, options.seed, report.seconds,
                 report.interrupted ? fmt::format("; interrupted, {} were requested", options.random) : "");
    print_power("cpu - oracle or path", report.oracle_power, judged_with.half_width_percent);
    print_power("vulkan - cpu, common seeds", report.common_power, judged_with.half_width_percent);
    print_result("{}\n", name_of(report.verdict));
}

}  // namespace

void add_random_option(CLI::App& command, VerifyOptions& options) {
    command
        .add_option("--random", options.random,
                    "Test this number of random scenes, with seeds from --seed on, instead of a scene file")
        ->check(CLI::Range(1U, 1U << 30U));
    CLI::Option* moving =
        command.add_flag("--moving", options.moving, "With --random: all scenes move, not only those of even seeds");
    command.add_flag("--still", options.still, "With --random: no scene moves")->excludes(moving);
    command.add_flag("--shrink,!--no-shrink", options.shrink,
                     "With --random: shrink scenes that fail before they are written; on by default");
}

int verify_random(const VerifyOptions& options) {
    check_options(options);
    if (!options.output.empty()) {
        prepare_folder(options.output);
    }
    const std::vector<std::string> backends =
        given(options, "--backends") || DIPTYCH_VULKAN == 0 ? options.backends : std::vector<std::string>{"cpu", "vulkan"};
    const Renderers renderers = make_renderers(options, backends);
    const RandomSuiteSettings settings = suite_settings(options);
    const InterruptGuard interrupt;
    RandomSuite report;
    {
        StepLine line(static_cast<int>(options.random));
        report = judge_random_scenes(settings, renderers, interrupt.requested(),
                                     {.begin = [&](std::uint64_t seed) { line.begin(fmt::format("seed {}", seed)); },
                                      .warn = report_warning});
    }
    Findings findings;
    for (const RandomFailure& failure : report.failures) {
        findings.failures.push_back(write_failure(failure, options, settings.judge.half_width_percent));
    }
    for (const RandomRefusal& refusal : report.refusals) {
        findings.refusals.push_back(write_refusal(refusal, options));
    }
    print_suite(options, settings.judge, report, findings);
    if (report.interrupted) {
        return interrupt_exit_code();
    }
    const bool fails = report.verdict == Verdict::fail || (options.require_pass && report.verdict != Verdict::pass);
    return fails ? exit_check_failed : exit_done;
}

}  // namespace diptych::core::app
