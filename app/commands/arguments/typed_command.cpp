#include "commands/arguments/typed_command.h"

#include <CLI/CLI.hpp>

#include <algorithm>

namespace diptych::core::app {

namespace {

std::string shell_word(const std::string& word) {
    constexpr const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./,:+=%@";
    if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) {
        return word;
    }
    std::string text = "'";
    for (const char c : word) {
        text += c == '\'' ? "'\\''" : std::string(1, c);
    }
    return text + "'";
}

std::string values_of(const CLI::Option& option) {
    std::string text;
    std::string joined;
    const char delimiter = option.get_delimiter();
    for (const std::string& value : option.results()) {
        joined += (joined.empty() ? "" : std::string(1, delimiter)) + value;
        text += " " + shell_word(value);
    }
    return delimiter != '\0' ? " " + shell_word(joined) : text;
}

}  // namespace

std::string typed_command(const CLI::App& command, const std::vector<std::string>& without,
                          const std::string& instead) {
    std::string positional;
    std::string options;
    for (const CLI::Option* option : command.get_options()) {
        const std::string name = option->get_name();
        if (option->count() == 0 || std::find(without.begin(), without.end(), name) != without.end()) {
            continue;
        }
        if (option->get_positional()) {
            positional += values_of(*option);
        } else {
            options += " " + name + (option->get_items_expected_max() > 0 ? values_of(*option) : "");
        }
    }
    return "diptych " + command.get_name() + positional + options + " " + instead;
}

}  // namespace diptych::core::app
