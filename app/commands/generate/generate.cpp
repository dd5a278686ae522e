#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "commands/arguments/recommended_arguments.h"
#include "commands/command.h"
#include "error.h"
#include "image/atomic_file.h"
#include "random_scene/scene_files.h"
#include "console/output.h"
#include "console/option_names.h"
#include "console/report.h"
#include "generate/generate.h"
#include "gltf/write.h"

namespace diptych::core::app {

namespace {

constexpr const char* generate_examples = R"(Examples:
  diptych generate --list
  diptych generate cornell -o cornell.gltf
  diptych generate many-lights -o street.glb --count 100000 --seed 7
  diptych generate random -o random.gltf --seed 7
  diptych generate random -o random.gltf --seed 7 --moving)";

constexpr const char* random_name = "random";

struct GenerateArguments {
    std::string name;
    std::string output;
    GenerateOptions generate;
    bool sets_count = false;
    bool sets_seed = false;
    bool moving = false;
    bool list = false;
    bool json = false;
};

int list_scenes(bool json) {
    nlohmann::ordered_json names = nlohmann::ordered_json::array();
    std::vector<SceneGenerator> all(scene_generators().begin(), scene_generators().end());
    all.insert(all.end(), extreme_scene_generators().begin(), extreme_scene_generators().end());
    all.push_back({random_name, "a small random scene, chosen by --seed, as verify --random tests them", nullptr});
    for (const SceneGenerator& generator : all) {
        const std::string description = with_option_names(generator.description);
        if (json) {
            names.push_back({{"name", generator.name}, {"description", description}});
        } else {
            print_result("{:<20} {}\n", generator.name, description);
        }
    }
    if (json) {
        print_json(names);
    }
    return exit_done;
}

/// Both return what `diptych render` wants beside the file.
std::string write_random(const GenerateArguments& options) {
    const std::uint64_t seed = options.generate.seed;
    const RandomScene random = options.moving ? make_moving_random_scene(seed) : make_random_scene(seed);
    write_random_scene(random, options.output);
    return recommended_arguments(random, options.output);
}

std::string write_generated(const GenerateArguments& options) {
    const GeneratedScene generated = generate_scene(options.name, options.generate);
    write_gltf(generated.scene, options.output);
    return recommended_arguments(generated.recommended);
}

int run_generate(const GenerateArguments& options) {
    if (options.list) {
        return list_scenes(options.json);
    }
    if (options.name.empty()) {
        throw Error("generate: needs the NAME of a scene; see diptych generate --list");
    }
    const bool random = options.name == random_name;
    const bool street = options.name == "many-lights";
    if ((options.sets_count && !street) || (options.sets_seed && !street && !random)) {
        throw Error(fmt::format("generate {}: --count works only with many-lights, --seed with many-lights and random",
                                options.name));
    }
    if (options.moving && !random) {
        throw Error(fmt::format("generate {}: --moving works only with random", options.name));
    }
    if (options.output.empty()) {
        throw Error(fmt::format("generate {}: needs a file to write, -o FILE", options.name));
    }
    const std::string extension = std::filesystem::path(options.output).extension().string();
    if (extension != ".gltf" && extension != ".glb") {
        throw Error(fmt::format("{}: the scene file must be .gltf or .glb", options.output));
    }
    check_file_can_be_created(options.output);
    if (extension == ".gltf") {
        check_file_can_be_created(std::filesystem::path(options.output).replace_extension(".bin"));
    }
    const std::string arguments = random ? write_random(options) : write_generated(options);
    if (options.json) {
        print_json({{"name", options.name}, {"output", options.output}, {"recommended_arguments", arguments}});
    } else {
        print_note("{}: written; to render it: diptych render {}{}{} -o picture.png\n", options.output, options.output,
                   arguments.empty() ? "" : " ", arguments);
    }
    return exit_done;
}

}  // namespace

void add_generate(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("generate", "Write one of the built-in scenes as glTF");
    auto options = std::make_shared<GenerateArguments>();
    command->add_option("name", options->name, "Name of the scene; see --list");
    command->add_option("-o,--output", options->output, "File to write: .gltf (with a .bin beside it) or .glb");
    CLI::Option* count = command->add_option("--count", options->generate.count, "many-lights: number of emitters")
                             ->check(CLI::Range(1U, 100000000U))
                             ->capture_default_str();
    CLI::Option* seed =
        command->add_option("--seed", options->generate.seed, "many-lights, random: seed that the scene is made from")
            ->capture_default_str();
    command->add_flag("--moving", options->moving, "random: let nodes and cameras move, and lights move and switch");
    command->add_flag("--list", options->list, "List the scenes");
    command->add_flag("--json", options->json, "Print the results as JSON");
    command->footer(generate_examples);
    command->callback([options, count, seed, &run] {
        options->sets_count = count->count() > 0;
        options->sets_seed = seed->count() > 0;
        run = [options] { return run_generate(*options); };
    });
}

}  // namespace diptych::core::app
