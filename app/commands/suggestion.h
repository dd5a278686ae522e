// What a user may have meant.
#pragma once

#include <string>

namespace CLI {
class App;
}  // namespace CLI

namespace diptych::core::app {

/// After a parse error: the nearest known command or option to the first unknown one, or where to find help.
std::string suggestion(const CLI::App& app, int argc, char** argv);

}  // namespace diptych::core::app
