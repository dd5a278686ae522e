#include "commands/arguments/backend_pair.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>

#include "session/open_session.h"
#include "error.h"

namespace diptych::core::app {

void add_pair_options(CLI::App& command, PairArguments& pair) {
    command.add_option("--backends", pair.backends, "Backends, comma-separated: cpu, vulkan")
        ->delimiter(',')
        ->capture_default_str();
    command.add_option("--device", pair.device, "Vulkan device, by index or name; default: the best");
    command.add_option("--threads", pair.threads, "CPU threads; default: one per core")->check(CLI::Range(1, 4096));
    command.add_flag("--validation", pair.validation, "Run Vulkan's validation layers");
}

void check_pair(const PairArguments& pair) {
    const auto& names = pair.backends;
    const auto has = [&](const char* name) { return std::count(names.begin(), names.end(), name) > 0; };
    for (const std::string& name : names) {
        if (name != "cpu" && name != "vulkan") {
            throw Error(fmt::format("--backends {}: there are only cpu, vulkan", name));
        }
        if (std::count(names.begin(), names.end(), name) > 1) {
            throw Error(fmt::format("--backends: {} is named twice", name));
        }
    }
    if (!has("vulkan") && (!pair.device.empty() || pair.validation)) {
        throw Error(
            fmt::format("{}: works only with the backend vulkan", pair.validation ? "--validation" : "--device"));
    }
    if (!has("cpu") && pair.threads != 0) {
        throw Error("--threads: works only with the backend cpu");
    }
}

std::vector<Session> open_sessions(const Scene& scene, const RenderSettings& settings, const PairArguments& pair) {
    std::vector<Session> sessions;
    for (const std::string& name : pair.backends) {
        RenderRequest request;
        request.settings = settings;
        request.backend = name;
        request.device = pair.device;
        request.threads = pair.threads;
        request.validation = pair.validation;
        sessions.push_back(open_session(scene, request));
    }
    return sessions;
}

}  // namespace diptych::core::app
