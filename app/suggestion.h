// What a user may have meant.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace diptych::app {

/// After a parse error: the nearest known command or option to the first unknown one, or where to find help.
std::string suggestion(const CLI::App& app, int argc, char** argv);

}  // namespace diptych::app
