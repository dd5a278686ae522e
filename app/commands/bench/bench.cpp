#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "commands/arguments/arguments.h"
#include "commands/command.h"
#include "console/output.h"
#include "console/interrupt.h"
#include "console/report.h"
#include "console/step_line.h"
#include "error.h"
#include "measure/bench_table.h"
#include "session/open_session.h"
#include "session/scene_setup.h"
#include "settings/names.h"

namespace diptych::core::app {

namespace {

constexpr const char* bench_examples = R"(Examples:
  diptych bench cornell.gltf --backend cpu
  diptych bench street.glb --backend vulkan --size 1920x1080 --integrators brdf,path --frames 20 --json
  diptych bench street.glb --backend vulkan --integrators direct,ris,restir --max-depth 1
Each figure is the median of the frames. The frames of restir reuse the previous one. The integrators take turns, so
that all are measured under the same conditions.)";

struct BenchOptions {
    RenderArguments arguments;
    std::vector<std::string> integrators{"brdf", "direct", "path"};
    std::uint32_t spp = 1;
    int frames = 9;
    bool json = false;
};

BenchSettings settings_of(const BenchOptions& options) {
    BenchSettings settings;
    for (const std::string& name : options.integrators) {
        settings.integrators.push_back(integrator_from_name(name));
    }
    settings.spp = options.spp;
    settings.frames = options.frames;
    return settings;
}

nlohmann::ordered_json to_json(const IntegratorBench& bench) {
    nlohmann::ordered_json json;
    json["integrator"] = name_of(bench.integrator);
    json["milliseconds"] = bench.milliseconds;
    json["samples_per_second"] = bench.samples_per_second;
    json["rays_per_second"] = bench.rays_per_second;
    json["bare_rays_per_second"] = nullptr;
    json["share_of_bare"] = nullptr;
    if (bench.bare) {
        json["bare_rays_per_second"] = bench.bare->rays_per_second;
        json["share_of_bare"] = bench.bare->share;
    }
    json["cost_relative_to_brdf"] = nullptr;
    if (bench.cost_relative_to_brdf) {
        json["cost_relative_to_brdf"] = *bench.cost_relative_to_brdf;
    }
    json["build_seconds"] = bench.costs.build_seconds;
    json["compile_seconds"] = bench.costs.compile_seconds;
    json["passes"] = nlohmann::ordered_json::array();
    for (const PassTime& pass : bench.passes) {
        json["passes"].push_back({{"pass", pass.pass}, {"milliseconds", 1000 * pass.seconds}});
    }
    json["bytes"] = bench.costs.bytes;
    return json;
}

nlohmann::ordered_json to_json(const BenchResult& result, const BenchOptions& options, bool interrupted) {
    const RenderSettings& settings = options.arguments.request.settings;
    nlohmann::ordered_json json;
    json["scene"] = options.arguments.request.scene;
    json["backend"] = result.backend;
    json["device"] = result.device;
    json["width"] = settings.width;
    json["height"] = settings.height;
    json["spp"] = options.spp;
    json["frames"] = result.frames;
    json["interrupted"] = interrupted;
    json["integrators"] = nlohmann::ordered_json::array();
    for (const IntegratorBench& bench : result.integrators) {
        json["integrators"].push_back(to_json(bench));
    }
    return json;
}

int run_bench(BenchOptions options) {
    resolve_names(options.arguments);
    const RenderRequest& request = options.arguments.request;
    if (request.backend == "oracle") {
        throw Error("--backend oracle: bench measures only cpu and vulkan");
    }
    const BenchSettings settings = settings_of(options);
    refuse_idle_resampling_options(
        options.arguments, std::any_of(settings.integrators.begin(), settings.integrators.end(), resamples));
    const Scene scene = prepare_scene(options.arguments);
    std::optional<BenchResult> result;
    bool interrupted = false;
    {
        InterruptGuard interrupt;
        StepLine line(bench_steps(settings));
        result = bench_integrators(settings, scene, request, open_requested, interrupt.requested(),
                                   [&](const std::string& step) { line.begin(step); });
        interrupted = interrupt.requested();
    }
    if (result && options.json) {
        print_json(to_json(*result, options, interrupted));
    } else if (result) {
        print_result("{}", bench_table(*result, request.settings.width, request.settings.height));
    }
    if (interrupted) {
        report_error(fmt::format("{}: interrupted after {} of {} frames", request.scene, result ? result->frames : 0,
                                 options.frames));
        return interrupt_exit_code();
    }
    return exit_done;
}

}  // namespace

void add_bench(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("bench", "Measure how fast a backend renders a scene");
    auto options = std::make_shared<BenchOptions>();
    command->add_option("scene", options->arguments.request.scene, ".gltf or .glb file")->required();
    command->add_option("--integrators", options->integrators, "Integrators to measure, comma-separated")
        ->delimiter(',')
        ->capture_default_str();
    command->add_option("--spp", options->spp, "Samples per pixel of each frame")
        ->check(CLI::Range(1U, 65536U))
        ->capture_default_str();
    command->add_option("--frames", options->frames, "Frames to measure; the median counts")
        ->check(CLI::Range(5, 10000))
        ->capture_default_str();
    command->add_option("--seed", options->arguments.request.settings.seed, "Seed of the random numbers")
        ->capture_default_str();
    add_scene_options(*command, options->arguments);
    add_backend_options(*command, options->arguments);
    command->add_flag("--json", options->json, "Print the results as JSON");
    command->footer(bench_examples);
    command->callback([options, &run] { run = [options] { return run_bench(*options); }; });
}

}  // namespace diptych::core::app
