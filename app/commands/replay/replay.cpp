#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>

#include "commands/arguments/backend_pair.h"
#include "commands/command.h"
#include "error.h"
#include "settings/names.h"
#include "commands/replay/text.h"
#include "console/output.h"
#include "console/report.h"
#include "session/scene_setup.h"

namespace diptych::core::app {

namespace {

constexpr const char* replay_examples = R"(Examples:
  diptych replay cornell.gltf --pixel 210,300 --sample 5
  diptych replay street.glb --pixel 12,40 --sample 0 --size 64x48 --seed 7 --integrator direct
  diptych replay cornell.gltf --pixel 210,300 --backends cpu --json
Both backends trace the same path from the same random numbers. Differences of numbers are relative to the larger
number, those of positions to the length of the ray; those of directions and barycentrics are absolute. '=' is a
difference of at most 1e-6.
Scene, size, seed and settings must be those of the picture. This includes --max-depth, which decides which vertex
is the last one.)";

struct ReplayOptions {
    RenderArguments arguments;
    PairArguments pair;
    std::vector<std::uint32_t> pixel;
    std::uint32_t sample = 0;
    std::uint32_t sample_count = 64;
    double tolerance = 1e-3;
    bool json = false;
};

void print_replay(const ReplayOptions& options, const Replay& replay, const shared::RenderConstants& constants) {
    const RenderSettings& settings = options.arguments.request.settings;
    if (options.json) {
        nlohmann::ordered_json json;
        json["scene"] = options.arguments.request.scene;
        json["integrator"] = name_of(settings.integrator);
        json["width"] = settings.width;
        json["height"] = settings.height;
        json["pixel"] = options.pixel;
        json["sample"] = options.sample;
        json["seed"] = settings.seed;
        json.update(replay_json(replay, constants));
        print_json(json);
        return;
    }
    print_result("{}: pixel {},{} of {}x{}, sample {}, seed {}, {}, depth {}\n", options.arguments.request.scene,
                 options.pixel[0], options.pixel[1], settings.width, settings.height, options.sample, settings.seed,
                 name_of(settings.integrator), settings.max_depth);
    print_result("{}", replay_text(replay, constants));
    if (replay.paths.size() > 1) {
        print_result("{}\n", parting_text(replay));
    }
}

int run_replay(ReplayOptions options) {
    RenderRequest& request = options.arguments.request;
    resolve_names(options.arguments);
    refuse_resampling("--integrator", options.arguments.request.settings.integrator, "replay");
    check_pair(options.pair);
    request.settings.sample_count = options.sample_count;
    const Scene scene = prepare_scene(options.arguments);
    const RenderSettings& settings = request.settings;
    if (options.pixel[0] >= static_cast<std::uint32_t>(settings.width) ||
        options.pixel[1] >= static_cast<std::uint32_t>(settings.height)) {
        throw Error(fmt::format("--pixel {},{}: lies outside the picture of {}x{}", options.pixel[0], options.pixel[1],
                                settings.width, settings.height));
    }
    const shared::PathQuery query{{options.pixel[0], options.pixel[1]}, options.sample};
    std::vector<Session> sessions = open_sessions(scene, settings, options.pair);
    const Replay replay = replay_path(sessions, query, options.tolerance);
    print_replay(options, replay, sessions.front().packed().constants);
    return exit_done;
}

}  // namespace

void add_replay(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("replay", "Trace one path on both backends and compare it vertex by vertex");
    auto options = std::make_shared<ReplayOptions>();
    command->add_option("scene", options->arguments.request.scene, ".gltf or .glb file")->required();
    command->add_option("--pixel", options->pixel, "Column and row of the pixel, from the top left")
        ->type_name("X,Y")
        ->delimiter(',')
        ->expected(2)
        ->required();
    command->add_option("--sample", options->sample, "Index of the sample in this pixel")->capture_default_str();
    command->add_option("--seed", options->arguments.request.settings.seed, "Seed of the picture")
        ->capture_default_str();
    command
        ->add_option("--sample-count", options->sample_count, "Size of the picture's hammersley set, samples per pixel")
        ->check(CLI::Range(1U, 4294967295U))
        ->capture_default_str();
    command->add_option("--tolerance", options->tolerance, "Largest difference that counts as rounding")
        ->check(non_negative_number())
        ->capture_default_str();
    add_integrator_option(*command, options->arguments);
    add_scene_options(*command, options->arguments);
    add_pair_options(*command, options->pair);
    command->add_flag("--json", options->json, "Print the results as JSON");
    command->footer(replay_examples);
    command->callback([options, &run] { run = [options] { return run_replay(*options); }; });
}

}  // namespace diptych::core::app
