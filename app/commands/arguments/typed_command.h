// The command line once more, for a message that says what to run.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace diptych::core::app {

/// The subcommand with what was typed, quoted for a shell, but without the options named ("--spp"), and with `instead`
/// behind it.
std::string typed_command(const CLI::App& command, const std::vector<std::string>& without,
                          const std::string& instead);

}  // namespace diptych::core::app
