#include "commands/arguments/typed_text.h"

#include <CLI/CLI.hpp>

#include <cctype>
#include <string>

namespace diptych::core::app {

namespace {

/// "-0010" becomes "-10"; "0x10" and "0.5" stay.
std::string drop_leading_zeros(std::string& text) {
    const std::size_t begin = text.empty() || (text[0] != '-' && text[0] != '+') ? 0 : 1;
    std::size_t end = begin;
    while (end + 1 < text.size() && text[end] == '0' && std::isdigit(static_cast<unsigned char>(text[end + 1])) != 0) {
        ++end;
    }
    text.erase(begin, end - begin);
    return {};
}

std::string refuse_empty(std::string& text) {
    return text.empty() ? "the text is empty; leave the option out instead" : "";
}

}  // namespace

void take_text_as_typed(CLI::App& program) {
    for (CLI::App* command : program.get_subcommands(nullptr)) {
        for (CLI::Option* option : command->get_options()) {
            if (option->get_items_expected_max() == 0) {
                continue;  // a flag
            }
            const std::string type = option->get_type_name();
            if (type.rfind("INT", 0) == 0 || type.rfind("UINT", 0) == 0) {
                option->transform(CLI::Validator(drop_leading_zeros, ""));
            }
            option->transform(CLI::Validator(refuse_empty, ""));
        }
    }
}

}  // namespace diptych::core::app
