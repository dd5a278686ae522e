// One scene on the backends that a command compares.
#pragma once

#include <string>
#include <vector>

#include "commands/arguments/arguments.h"
#include "render/session.h"

namespace diptych::core::app {

/// Options as typed. Device and threads are kept apart from the request, each for the backend that it is meant for.
struct PairArguments {
    std::vector<std::string> backends{"cpu", "vulkan"};
    std::string device;
    int threads = 0;
    bool validation = false;
};

/// --backends, --device, --threads, --validation.
void add_pair_options(CLI::App& command, PairArguments& pair);

/// Throws Error for a backend that does not exist, or is named twice, or an option that goes with none of them.
void check_pair(const PairArguments& pair);

/// At rest, in the order asked for. The scene must outlive them.
std::vector<Session> open_sessions(const Scene& scene, const RenderSettings& settings, const PairArguments& pair);

}  // namespace diptych::core::app
