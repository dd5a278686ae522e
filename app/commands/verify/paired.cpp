#include "commands/verify/paired.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "clock.h"
#include "commands/command.h"
#include "error.h"
#include "image/figures.h"
#include "image/image_file.h"
#include "measure/paired_run.h"
#include "console/interrupt.h"
#include "console/output.h"
#include "console/repeat_command.h"
#include "settings/names.h"
#include "console/report.h"
#include "session/input_files.h"
#include "session/scene_setup.h"

namespace diptych::core::app {

namespace {

struct Figured {
    PairedRun paths;
    double seconds = 0;  // sessions included
    std::string figure;  // file; empty where none was asked for
};

double percent(std::uint64_t part, std::uint64_t whole) {
    return whole == 0 ? 0 : 100 * static_cast<double>(part) / static_cast<double>(whole);
}

double largest_z(const PairedReport& report) {
    return *std::max_element(report.divergent_z.begin(), report.divergent_z.end(),
                             [](double a, double b) { return std::abs(a) < std::abs(b); });
}

void print_report(RenderRequest request, const Figured& run) {
    request.settings.integrator = run.paths.integrator;
    const PairedReport& report = run.paths.report;
    print_result("{}: {} paths; {:.4f} % decided alike, their largest difference is {:.2e}",
                 name_of(run.paths.integrator), report.paths, percent(report.alike, report.paths),
                 report.worst_relative);
    print_result("{}\n", report.drifted > 0 ? fmt::format(", {} are above 1e-3", report.drifted) : "");
    print_result("  {:>8} {:>12} {:>10} {:>12}\n", "vertex", "paths", "parted", "fraction");
    for (std::size_t i = 0; i < report.bounces.size(); ++i) {
        const PairedBounce& bounce = report.bounces[i];
        print_result("  {:>8} {:>12} {:>10} {:>12.2e}\n", i, bounce.reached, bounce.parted,
                     percent(bounce.parted, bounce.reached) / 100);
    }
    const auto& sum = report.divergent_sum;
    const auto& error = report.divergent_error;
    print_result("  sum of the signed differences {:.3g} {:.3g} {:.3g} +- {:.3g} {:.3g} {:.3g}, z {:.2f}\n", sum[0],
                 sum[1], sum[2], error[0], error[1], error[2], largest_z(report));
    for (const PairedExample& example : report.drifted_examples) {
        print_result("  drifted by {:.2e}: {}\n", example.difference, replay_command(request, example.query));
    }
    for (const PairedExample& example : report.parted_examples) {
        print_result("  parts at vertex {}: {}\n", example.vertex, replay_command(request, example.query));
    }
    print_result("  {}{} in {:.1f} s\n", name_of(report.verdict), report.reason.empty() ? "" : ": " + report.reason,
                 run.seconds);
    if (!run.figure.empty()) {
        print_result("  {}: fraction of each pixel's paths that part, from 0 (black) to 10 % (yellow)\n", run.figure);
    }
}

nlohmann::ordered_json examples_json(const std::vector<PairedExample>& examples) {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const PairedExample& example : examples) {
        json.push_back({{"pixel", {example.query.pixel.x, example.query.pixel.y}},
                        {"sample", example.query.sample_index},
                        {"vertex", example.vertex},
                        {"difference", example.difference}});
    }
    return json;
}

nlohmann::ordered_json run_json(const Figured& run) {
    const PairedReport& report = run.paths.report;
    nlohmann::ordered_json json;
    json["integrator"] = name_of(run.paths.integrator);
    json["devices"] = run.paths.devices;
    json["paths"] = report.paths;
    json["alike_percent"] = percent(report.alike, report.paths);
    json["worst_relative"] = report.worst_relative;
    json["drifted"] = report.drifted;
    json["drifted_p"] = report.drifted_p;
    json["nonfinite"] = report.nonfinite;
    json["vertices"] = nlohmann::ordered_json::array();
    for (const PairedBounce& bounce : report.bounces) {
        json["vertices"].push_back({{"paths", bounce.reached}, {"parted", bounce.parted}, {"p", bounce.p}});
    }
    json["divergent_sum"] = report.divergent_sum;
    json["divergent_error"] = report.divergent_error;
    json["divergent_z"] = report.divergent_z;
    json["drifted_examples"] = examples_json(report.drifted_examples);
    json["parted_examples"] = examples_json(report.parted_examples);
    json["seconds"] = run.seconds;
    json["verdict"] = name_of(report.verdict);
    json["reason"] = report.reason;
    if (!run.figure.empty()) {
        json["output"] = run.figure;
    }
    return json;
}

PairedVerdict worst_verdict(const std::vector<Figured>& runs) {
    PairedVerdict worst = PairedVerdict::pass;
    for (const Figured& run : runs) {
        const PairedVerdict verdict = run.paths.report.verdict;
        if (verdict == PairedVerdict::fail || worst == PairedVerdict::pass) {
            worst = verdict;
        }
    }
    return worst;
}

std::filesystem::path figure_path(const std::string& folder, Integrator integrator) {
    return std::filesystem::path(folder) / fmt::format("paired-{}.png", name_of(integrator));
}

}  // namespace

int run_paired(RenderArguments arguments, const PairArguments& pair, const PairedOptions& options) {
    check_pair(pair);
    if (pair.backends.size() != 2) {
        throw Error("--paired: needs two backends, such as --backends cpu,vulkan");
    }
    for (const Integrator integrator : options.integrators) {
        refuse_resampling("--integrators", integrator, "verify --paired");
    }
    if (!options.folder.empty() && !std::filesystem::is_directory(options.folder)) {
        throw Error(fmt::format("{}: is not a folder", options.folder));
    }
    if (!options.folder.empty()) {
        std::vector<std::filesystem::path> figures;
        for (const Integrator integrator : options.integrators) {
            figures.push_back(figure_path(options.folder, integrator));
        }
        refuse_inputs(figures, arguments.request);
    }
    arguments.request.settings.sample_count = options.spp;
    const Scene scene = prepare_scene(arguments);
    std::vector<Figured> runs;
    const InterruptGuard interrupt;
    for (const Integrator integrator : options.integrators) {
        if (interrupt.requested()) {
            break;
        }
        RenderSettings settings = arguments.request.settings;
        settings.integrator = integrator;
        const Stopwatch watch;
        std::vector<Session> sessions = open_sessions(scene, settings, pair);
        Figured run{compare_all_paths(sessions.front(), sessions.back(), options.spp, interrupt.requested()),
                    watch.seconds(), ""};
        if (!options.folder.empty()) {
            run.figure = figure_path(options.folder, integrator).string();
            write_png(run.figure, heatmap(run.paths.differing, 0, 0.1F));
        }
        if (!options.json) {
            print_report(arguments.request, run);
        }
        runs.push_back(std::move(run));
    }
    const PairedVerdict verdict = worst_verdict(runs);
    if (options.json) {
        nlohmann::ordered_json json;
        json["scene"] = arguments.request.scene;
        json["backends"] = pair.backends;
        json["verdict"] = name_of(verdict);
        json["interrupted"] = interrupt.requested().load();
        json["pairs"] = nlohmann::ordered_json::array();
        for (const Figured& run : runs) {
            json["pairs"].push_back(run_json(run));
        }
        print_json(json);
    } else {
        print_result("{}\n", name_of(verdict));
    }
    if (interrupt.requested()) {
        report_error(fmt::format("{}: interrupted; the paths so far were compared", arguments.request.scene));
        return interrupt_exit_code();
    }
    const bool fails = verdict == PairedVerdict::fail || (options.require_pass && verdict != PairedVerdict::pass);
    return fails ? exit_check_failed : exit_done;
}

}  // namespace diptych::core::app
