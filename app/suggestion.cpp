#include "suggestion.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <numeric>
#include <vector>

namespace diptych::app {

namespace {

/// Levenshtein's distance.
std::size_t distance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
        }
    }
    return row.back();
}

std::string nearest(const std::string& word, const std::vector<std::string>& known) {
    std::string best;
    std::size_t least = 1 + word.size() / 3;
    for (const std::string& candidate : known) {
        const std::size_t d = distance(word, candidate);
        if (d <= least && (best.empty() || d < least)) {
            best = candidate;
            least = d;
        }
    }
    return best;
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& known, const std::string& help) {
    const std::string guess = nearest(word, known);
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
        return did_you_mean(name, commands, "diptych --help");
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
            return did_you_mean(word, options, help);
        }
    }
    return "see " + help;
}

}  // namespace diptych::app
