#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "build_info.h"
#include "clock.h"
#include "commands/arguments/device_loss.h"
#include "commands/command.h"
#include "commands/converge/plan.h"
#include "console/interrupt.h"
#include "console/output.h"
#include "console/report.h"
#include "console/step_line.h"
#include "error.h"
#include "image/atomic_file.h"
#include "image/image_file.h"
#include "image/picture_name.h"
#include "measure/converge/charts.h"
#include "measure/converge/measurement.h"
#include "measure/converge/page.h"
#include "measure/converge/pictures.h"
#include "measure/converge/report.h"
#include "console/repeat_command.h"
#include "session/input_files.h"
#include "session/open_session.h"
#include "session/scene_setup.h"

namespace diptych::core::app {

namespace {

constexpr const char* default_converge_size = "256";

constexpr const char* converge_examples = R"(Examples:
  diptych converge cornell.gltf -o report
  diptych converge scene.glb --methods cpu:path,vulkan:path,vulkan:restir --time 2 --size 640x360 -o report
  diptych converge cornell.gltf --methods cpu:path:independent,cpu:path:hammersley,cpu:path:sobol --spp-max 1024 -o samplers
  diptych converge scene.glb --methods vulkan:path --reference truth.exr --spp-max 4096 --runs 32 --json -o report
Renders each method --runs times, each run with its own seed, and compares it with the reference at 1, 2, 4, 8...
samples per pixel. The report shows the error over samples and time, its slope, its bias, and the time to a target
error. Open index.html in the output folder when it is done. Ctrl-C stops; the same command continues from there.
docs/converge.md describes the files.)";

ReportHead head_of(const ConvergeOptions& options) {
    return {options.arguments.request, options, build_info::commit, options.command};
}

/// Writes what the results so far say into the folder; all of it as JSON.
nlohmann::ordered_json write_report(const ConvergeOptions& options, const std::vector<Method>& methods,
                                    const ConvergeSummary& summary, const ReferencePicture& reference,
                                    const ConvergeState& state) {
    nlohmann::ordered_json json = summary_to_json(head_of(options), summary, reference, state);
    write_page_pictures(methods, reference, options.page_side, state);
    write_file_atomically(state.path("summary.json"), json.dump(2) + "\n");
    write_file_atomically(state.path("summary.csv"), summary_to_csv(summary));
    write_charts(json, state);
    write_page(json, state);
    return json;
}

/// The files of the folder that an input could be: pictures, and what a scene could name as a buffer or texture.
std::vector<std::filesystem::path> written_files(const ConvergeOptions& options, const std::vector<Method>& methods) {
    const std::filesystem::path folder = options.folder;
    std::vector<std::filesystem::path> files{folder / "pictures/reference.png"};
    if (!reference_is_file(options)) {
        files.push_back(folder / "reference.exr");
        files.push_back(folder / "reference.blocks");
    }
    for (const Method& method : methods) {
        for (const char* ending : {".exr", ".png", "-error.png"}) {
            files.push_back(folder / "pictures" / (file_stem(method.name) + ending));
        }
        files.push_back(folder / (file_stem(method.name) + ".sums"));
    }
    return files;
}

void refuse_to_write_over_inputs(const ConvergeOptions& options, const std::vector<Method>& methods) {
    std::vector<std::filesystem::path> inputs = input_files(options.arguments.request);
    if (reference_is_file(options)) {
        inputs.push_back(picture_name(options.reference).file);
    }
    refuse_inputs(written_files(options, methods), inputs);
}

ConvergeSubject plan_subject(const ConvergeOptions& options, const Scene& scene) {
    ConvergeSubject subject{scene, planned_methods(options), {}, {}, open_requested,
                            device_loss_policy(options.on_device_lost, false, options.arguments.request)};
    refuse_to_write_over_inputs(options, subject.methods);
    if (reference_is_file(options)) {
        const RenderSettings& settings = options.arguments.request.settings;
        subject.given_reference = load_reference(options.reference, settings.width, settings.height,
                                                 options.arguments.request.memory_limit);
    } else {
        subject.reference = planned_reference(options, subject.methods);
    }
    return subject;
}

int run_converge(ConvergeOptions options) {
    options.maker = this_program();
    if (options.arguments.size.empty() && !reference_is_file(options)) {
        options.arguments.size = default_converge_size;
    }
    if (options.arguments.size.empty()) {
        const Image image = read_image(options.reference, "", options.arguments.request.memory_limit).color;
        options.arguments.size = fmt::format("{}x{}", image.width, image.height);
    }
    check_converge_options(options);
    const Stopwatch loading;
    const Scene scene = prepare_scene(options.arguments);
    const double load_seconds = loading.seconds();
    const ConvergeSubject subject = plan_subject(options, scene);
    const FileLock lock = claim_folder(options, plan_to_json(options, subject.methods));
    ConvergeState state(options.folder);
    if (!state.load_seconds()) {
        state.set_load_seconds(load_seconds);
    }
    bool whole = false;
    std::string lost;  // why the device was
    nlohmann::ordered_json json;
    {
        StepLine line(converge_steps(options, subject.methods.size()));
        const StepHook begin = [&](const std::string& step) { line.begin(step); };
        ConvergeMeasurement measurement(options, subject, state, begin);
        {
            InterruptGuard interrupt;
            try {
                whole = measurement.run(interrupt.requested());
            } catch (const DeviceLost& error) {
                lost = error.what();
            }
        }
        if (const std::optional<ConvergeSummary> summary = measurement.summary()) {
            json = write_report(options, subject.methods, *summary, *measurement.reference(), state);
            if (!options.json) {
                print_result("{} Page: {}/index.html\n",
                             summary_table(head_of(options), *summary, *measurement.reference()), options.folder);
            }
        }
    }
    if (!json.is_null() && options.json) {
        json["interrupted"] = !whole;
        print_json(json);
    }
    if (!whole) {
        report_error(fmt::format("{}: {}; the same command goes on from here", options.folder,
                                 lost.empty() ? "interrupted" : lost));
    }
    return whole ? exit_done : lost.empty() ? interrupt_exit_code() : exit_no_device;
}

/// The command line as typed.
std::string typed(const CLI::App& command) {
    std::string text = "diptych " + command.get_name();
    for (const CLI::Option* option : command.get_options()) {
        if (option->count() == 0 || option->get_name() == "--json") {
            continue;
        }
        if (!option->get_positional()) {
            text += " " + option->get_name();
        }
        if (option->get_items_expected_max() > 0) {
            const bool listed = option->get_delimiter() != '\0';
            text += " " +
                    (listed ? shell_quoted(fmt::format("{}", fmt::join(option->results(), ",")))
                            : fmt::format("{}", fmt::join(option->results(), fmt::format(" {} ", option->get_name()))));
        }
    }
    return text;
}

}  // namespace

void add_converge(CLI::App& app, Run& run) {
    CLI::App* command =
        app.add_subcommand("converge", "Measure how the error falls with samples and time, and write a report");
    auto options = std::make_shared<ConvergeOptions>();
    RenderRequest& request = options->arguments.request;
    command->add_option("scene", request.scene, ".gltf or .glb file")->required();
    command
        ->add_option("--methods", options->methods,
                     "Methods, comma-separated: BACKEND:INTEGRATOR[:SAMPLER], such as vulkan:path, or oracle[:MODE]")
        ->delimiter(',')
        ->capture_default_str();
    CLI::Option* spp =
        command->add_option("--spp-max", options->spp_max, "Samples per pixel of a run, rounded down to a power of two")
            ->check(CLI::Range(1U, 1U << 24U))
            ->capture_default_str();
    command
        ->add_option("--time", options->seconds,
                     "Seconds per run, replaces --spp-max: a method renders the power of two of samples that fits")
        ->check(CLI::Range(0.001, 1e9))
        ->check(finite_number())
        ->excludes(spp);
    command->add_option("--runs", options->runs, "Runs of each method, each with its own seed")
        ->check(CLI::Range(2, 4096))
        ->capture_default_str();
    command
        ->add_option("--reference", options->reference,
                     "Image file, or BACKEND:INTEGRATOR[:SAMPLER] to render with 16 times the samples; auto: "
                     "path, if it is not measured itself")
        ->capture_default_str();
    command
        ->add_option("--target-relmse", options->target_relmse,
                     "relMSE to report the time to; default: the median of the methods' last relMSE")
        ->check(positive_number());
    command
        ->add_option("--picture-time", options->picture_seconds,
                     "Rendering time of the page's pictures, seconds; default: the shortest of the methods' runs")
        ->check(positive_number());
    command
        ->add_option("--page-side", options->page_side,
                     "Largest side of the page's pictures, pixels; larger ones are subsampled")
        ->check(CLI::Range(16, 32768))
        ->capture_default_str();
    command->add_option("--seed", options->seed, "Seed that the seeds of all renders derive from")
        ->capture_default_str();
    add_scene_options(*command, options->arguments);
    command->add_option("--device", request.device, "Vulkan device, by index or name; default: the best");
    command->add_option("--threads", request.threads, "Threads of cpu or oracle; default: one per core")
        ->check(CLI::Range(1, 4096));
    command->add_flag("--validation", request.validation,
                      "Run Vulkan's validation layers; exit code 1 if they report anything");
    command->add_option("-o,--output", options->folder, "Folder for the results; index.html is the page")->required();
    add_device_loss_option(*command, options->on_device_lost, false);
    command->add_flag("--json", options->json, "Print the results as JSON");
    command->footer(converge_examples);
    command->callback([options, command, &run] {
        options->command = typed(*command);
        run = [options] { return run_converge(*options); };
    });
}

}  // namespace diptych::core::app
