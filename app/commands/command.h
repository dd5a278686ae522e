// The subcommands, one file each. Each adds itself to the program's parser and, when chosen, sets what is to be run.
#pragma once

#include <functional>

#include "console/exit_codes.h"

namespace CLI {
class App;
}  // namespace CLI

namespace diptych::core::app {

/// Returns the exit code; throws Error and NoDevice.
using Run = std::function<int()>;

void add_render(CLI::App& app, Run& run);
void add_merge(CLI::App& app, Run& run);
void add_compare(CLI::App& app, Run& run);
void add_info(CLI::App& app, Run& run);
void add_generate(CLI::App& app, Run& run);
void add_bench(CLI::App& app, Run& run);
void add_verify(CLI::App& app, Run& run);
void add_replay(CLI::App& app, Run& run);
void add_converge(CLI::App& app, Run& run);
void add_stability(CLI::App& app, Run& run);
void add_view(CLI::App& app, Run& run);

}  // namespace diptych::core::app
