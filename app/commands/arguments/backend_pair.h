// One scene on the backends that a command compares.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "commands/arguments/arguments.h"
#include "pack/packed_scene.h"
#include "render/renderer.h"

namespace diptych::app {

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

/// In the order asked for. Scene and pack must outlive them.
std::vector<std::unique_ptr<Renderer>> make_renderers(const Scene& scene, const PackedScene& packed,
                                                      const PairArguments& pair);

}  // namespace diptych::app
