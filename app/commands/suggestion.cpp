#include "commands/suggestion.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <vector>

#include "near_miss.h"

namespace diptych::core::app {

namespace {

std::string guess_or_help(const std::string& word, const std::vector<std::string>& known, const std::string& help) {
    const std::string guess = nearest_word(word, known);
    return guess.empty() ? "see " + help : "did you mean " + guess + "?";
}

}  // namespace

std::string suggestion(const CLI::App& app, int argc, char** argv) {
    std::vector<std::string> commands;
    for (const CLI::App* command : app.get_subcommands(nullptr)) {
        commands.push_back(command->get_name());
    }
    if (argc < 2) {
        return "see diptych --help";
    }
    const std::string name = argv[1];
    if (std::find(commands.begin(), commands.end(), name) == commands.end()) {
        return guess_or_help(name, commands, "diptych --help");
    }
    std::vector<std::string> options;
    for (const CLI::Option* option : app.get_subcommand(name)->get_options()) {
        for (const std::string& long_name : option->get_lnames()) {
            options.push_back("--" + long_name);
        }
    }
    const std::string help = "diptych " + name + " --help";
    for (int i = 2; i < argc; ++i) {
        const std::string word = std::string(argv[i]).substr(0, std::string(argv[i]).find('='));
        if (word.rfind("--", 0) == 0 && std::find(options.begin(), options.end(), word) == options.end()) {
            return guess_or_help(word, options, help);
        }
    }
    return "see " + help;
}

}  // namespace diptych::core::app
