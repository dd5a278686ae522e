#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>

#include "commands/arguments/arguments.h"
#include "commands/arguments/backend_pair.h"
#include "commands/command.h"
#include "console/interrupt.h"
#include "console/report.h"
#include "commands/stability/report.h"
#include "console/step_line.h"
#include "commands/verify/report.h"

namespace diptych::core::app {

namespace {

constexpr const char* stability_examples = R"(Examples:
  diptych stability
  diptych stability --quick --backends cpu
  diptych stability --rows "GGX D,solid angle" -o stability
Evaluates shared functions and small pictures at extreme inputs on each backend, and compares them with double
precision and closed forms. The exit code is 1 if an error exceeds its bound or a result is not finite.)";

struct StabilityOptions {
    PairArguments pair;
    std::vector<std::string> rows;
    std::string output;
    bool quick = false;
    bool list = false;
    bool json = false;
};

std::vector<std::unique_ptr<stability::Backend>> make_backends(const PairArguments& pair) {
    std::vector<std::unique_ptr<stability::Backend>> backends;
    for (const std::string& name : pair.backends) {
        backends.push_back(name == "cpu" ? stability::make_cpu_backend(pair.threads)
                                         : stability::make_vulkan_backend(pair.device, pair.validation));
    }
    return backends;
}

int run_stability(const StabilityOptions& options) {
    check_pair(options.pair);
    const std::vector<const stability::Case*> cases = stability::cases_of(options.rows);
    if (options.list) {
        print_case_list(cases, options.json);
        return exit_done;
    }
    if (!options.output.empty()) {
        prepare_folder(options.output);
    }
    const stability::Effort effort = options.quick ? stability::Effort::quick : stability::Effort::full;
    const InterruptGuard interrupt;
    stability::Report report;
    {
        const auto backends = make_backends(options.pair);
        StepLine line(static_cast<int>(cases.size() * backends.size()));
        report = stability::run_cases(cases, backends, effort, interrupt.requested(),
                                      [&](const std::string& what) { line.begin(what); });
    }
    const std::vector<std::string> files =
        options.output.empty() ? std::vector<std::string>() : write_report(report, options.output);
    if (options.json) {
        nlohmann::ordered_json json = app::to_json(report);
        json["files"] = files;
        print_json(json);
    } else {
        print_report(report);
    }
    if (report.interrupted) {
        report_error(fmt::format("interrupted: {} of {} cases were measured", report.cases.size(), cases.size()));
        return interrupt_exit_code();
    }
    return passes(report) ? exit_done : exit_check_failed;
}

}  // namespace

void add_stability(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("stability", "Measure numerical errors at extreme inputs on this machine");
    auto options = std::make_shared<StabilityOptions>();
    command->add_option("--rows", options->rows, "Rows of the table to measure, comma-separated; see --list")
        ->delimiter(',');
    command->add_flag("--quick", options->quick, "Use fewer points and samples: half a minute instead of minutes");
    add_pair_options(*command, options->pair);
    command->add_option("-o,--output", options->output,
                        "Folder for the table as CSV and JSON, and a plot (SVG) of each case that has a range");
    command->add_flag("--list", options->list, "List the rows and cases");
    command->add_flag("--json", options->json, "Print the results as JSON");
    command->footer(stability_examples);
    command->callback([options, &run] { run = [options] { return run_stability(*options); }; });
}

}  // namespace diptych::core::app
