#include <fmt/format.h>

#include <algorithm>

#include "session/make_renderer.h"
#include "error.h"
#include "oracle_renderer/oracle_renderer.h"
#include "settings/names.h"
#include "commands/verify/options.h"

namespace diptych::core::app {

namespace {

void check_backend(const std::string& option, const std::string& name) {
    const std::vector<std::string> known = backend_names();
    if (std::find(known.begin(), known.end(), name) == known.end()) {
        throw Error(fmt::format("{} {}: there are only {}", option, name, fmt::join(known, ", ")));
    }
}

template <class T>
void check_distinct(const std::string& option, std::vector<T> names) {
    if (names.empty()) {
        throw Error(fmt::format("{}: the list is empty", option));
    }
    std::sort(names.begin(), names.end());
    const auto twice = std::adjacent_find(names.begin(), names.end());
    if (twice != names.end()) {
        throw Error(fmt::format("{}: names {} twice", option, *twice));
    }
}

void check_backend_options(const VerifyOptions& options, const std::vector<PairName>& pairs) {
    const RenderRequest& request = options.arguments.request;
    const auto uses = [&](bool (*wanted)(const std::string&)) {
        return std::any_of(pairs.begin(), pairs.end(),
                           [&](const PairName& pair) { return wanted(pair.a.backend) || wanted(pair.b.backend); });
    };
    const bool vulkan = uses([](const std::string& backend) { return backend == "vulkan"; });
    if (!vulkan && (!request.device.empty() || request.validation)) {
        throw Error(fmt::format("--{}: works only with vulkan, which is not among the backends",
                                request.validation ? "validation" : "device"));
    }
    if (request.threads != 0 && !uses([](const std::string& backend) { return backend != "vulkan"; })) {
        throw Error("--threads: works only with the CPU, which is not among the backends");
    }
}

}  // namespace

std::vector<PairName> plan_pairs(const VerifyOptions& options) {
    check_distinct("--backends", options.backends);
    check_distinct("--integrators", options.integrators);
    const std::size_t slash = options.against.find('/');
    const std::string reference = options.against.substr(0, slash);
    check_backend("--against", reference);
    const std::string choice = slash == std::string::npos ? "" : options.against.substr(slash + 1);
    std::vector<PairName> pairs;
    for (const std::string& backend : options.backends) {
        check_backend("--backends", backend);
        for (const std::string& integrator : options.integrators) {
            PairName pair;
            pair.a.backend = backend;
            pair.b.backend = reference;
            const Integrator typed = integrator_from_name(integrator);
            pair.a.integrator = backend == "oracle" ? Integrator::path : typed;
            if (reference == "oracle") {
                pair.b.oracle_mode = slash == std::string::npos ? pair.b.oracle_mode : choice;
                oracle_mode_from_name(pair.b.oracle_mode);
            } else {
                pair.b.integrator = slash == std::string::npos ? typed : integrator_from_name(choice);
            }
            for (const std::uint32_t frame : options.frames) {
                pair.frame = frame;
                pairs.push_back(pair);
            }
            if (options.frames.empty()) {
                pairs.push_back(pair);
            }
        }
    }
    check_backend_options(options, pairs);
    if (options.common_seeds && options.against_spp != 0) {
        throw Error("--against-spp: --common-seeds needs the same samples on both sides");
    }
    if (options.common_seeds && (reference == "oracle" || std::count(options.backends.begin(), options.backends.end(),
                                                                     std::string("oracle")) > 0)) {
        throw Error("--common-seeds: the oracle has random numbers of its own, so it shares none");
    }
    return pairs;
}

}  // namespace diptych::core::app
