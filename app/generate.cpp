#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "command.h"
#include "error.h"
#include "image/atomic_file.h"
#include "report.h"
#include "scene/generate.h"
#include "scene/gltf_write.h"

namespace diptych::app {

namespace {

constexpr const char* generate_examples = R"(Examples:
  diptych generate --list
  diptych generate cornell -o cornell.gltf
  diptych generate many-lights -o street.glb --count 100000 --seed 7)";

struct GenerateArguments {
    std::string name;
    std::string output;
    GenerateOptions generate;
    bool sets_street = false;  // --count or --seed was given
    bool list = false;
    bool json = false;
};

int list_scenes(bool json) {
    nlohmann::ordered_json names = nlohmann::ordered_json::array();
    std::vector<SceneGenerator> all(scene_generators().begin(), scene_generators().end());
    all.insert(all.end(), extreme_scene_generators().begin(), extreme_scene_generators().end());
    for (const SceneGenerator& generator : all) {
        if (json) {
            names.push_back({{"name", generator.name}, {"description", generator.description}});
        } else {
            fmt::print("{:<20} {}\n", generator.name, generator.description);
        }
    }
    if (json) {
        print_json(names);
    }
    return exit_done;
}

int run_generate(const GenerateArguments& options) {
    if (options.list) {
        return list_scenes(options.json);
    }
    if (options.name.empty()) {
        throw Error("generate: wants the NAME of a scene; see diptych generate --list");
    }
    if (options.sets_street && options.name != "many-lights") {
        throw Error(fmt::format("generate {}: --count and --seed are for many-lights alone", options.name));
    }
    if (options.output.empty()) {
        throw Error(fmt::format("generate {}: wants a file to write, -o FILE", options.name));
    }
    const std::string extension = std::filesystem::path(options.output).extension().string();
    if (extension != ".gltf" && extension != ".glb") {
        throw Error(fmt::format("{}: a scene is written as .gltf or .glb", options.output));
    }
    check_file_can_be_created(options.output);
    if (extension == ".gltf") {
        check_file_can_be_created(std::filesystem::path(options.output).replace_extension(".bin"));
    }
    const GeneratedScene generated = generate_scene(options.name, options.generate);
    write_gltf(generated.scene, options.output);
    const std::string arguments = generated.recommended_arguments;
    if (options.json) {
        print_json({{"name", options.name}, {"output", options.output}, {"recommended_arguments", arguments}});
    } else {
        fmt::print("{}: written; to see it: diptych render {}{}{} -o picture.png\n", options.output, options.output,
                   arguments.empty() ? "" : " ", arguments);
    }
    return exit_done;
}

}  // namespace

void add_generate(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("generate", "Write one of our own scenes as glTF");
    auto options = std::make_shared<GenerateArguments>();
    command->add_option("name", options->name, "Scene; see --list");
    command->add_option("-o,--output", options->output, "File to write: .gltf (with a .bin beside it) or .glb");
    CLI::Option* count = command->add_option("--count", options->generate.count, "many-lights: emitters")
                             ->check(CLI::Range(1U, 100000000U))
                             ->capture_default_str();
    CLI::Option* seed =
        command->add_option("--seed", options->generate.seed, "many-lights: which street")->capture_default_str();
    command->add_flag("--list", options->list, "Say which scenes there are");
    command->add_flag("--json", options->json, "Results as JSON on stdout");
    command->footer(generate_examples);
    command->callback([options, count, seed, &run] {
        options->sets_street = count->count() > 0 || seed->count() > 0;
        run = [options] { return run_generate(*options); };
    });
}

}  // namespace diptych::app
