#include "measure/converge/plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "error.h"
#include "settings/names.h"

namespace diptych::core {

namespace {

std::vector<std::string> parts_of(const std::string& text) {
    std::vector<std::string> parts(1);
    for (const char c : text) {
        if (c == ':') {
            parts.emplace_back();
        } else {
            parts.back() += c;
        }
    }
    return parts;
}

/// Reads the parts after the backend.
void read_parts(const std::vector<std::string>& parts, RenderRequest& request) {
    if (request.backend == "oracle") {
        request.oracle_mode = parts.size() > 1 ? parts[1] : RenderRequest{}.oracle_mode;
        request.settings.integrator = Integrator::path;
        return;
    }
    request.settings.integrator = integrator_from_name(parts[1]);
    if (parts.size() > 2) {
        request.settings.sampler = sampler_from_name(parts[2]);
    }
}

}  // namespace

std::string backend_in(const std::string& method) {
    return parts_of(method).front();
}

bool names_method(const std::string& text) {
    const std::string backend = backend_in(text);
    return backend == "cpu" || backend == "vulkan" || backend == "oracle";
}

Method method_named(const char* setting, const std::string& name, const RenderRequest& base, const SeedPlan& seeds,
                    std::uint32_t place) {
    const std::vector<std::string> parts = parts_of(name);
    if (!names_method(name)) {
        throw Error(
            fmt::format("{} {}: expected BACKEND:INTEGRATOR; the backends are cpu, vulkan, oracle", setting, name));
    }
    const bool oracle = parts.front() == "oracle";
    if (parts.size() > (oracle ? 2U : 3U) || (!oracle && parts.size() < 2)) {
        throw Error(
            fmt::format("{} {}: expected cpu:INTEGRATOR[:SAMPLER], vulkan:INTEGRATOR[:SAMPLER] or oracle[:MODE]",
                        setting, name));
    }
    Method method{.name = name, .request = base, .seeds = seeds, .place = place};
    method.request.settings.seed = method.seed_of(0);
    method.request.backend = parts.front();
    if (method.request.backend == "vulkan") {
        method.request.threads = 0;
    } else {
        method.request.device.clear();
        method.request.validation = false;
    }
    try {
        read_parts(parts, method.request);
    } catch (const Error& error) {
        throw Error(fmt::format("{} {}: {}", setting, name, error.what()));
    }
    return method;
}

std::vector<Method> plan_methods(const std::vector<std::string>& names, const RenderRequest& base, std::uint32_t seed,
                                 std::uint32_t runs) {
    const auto count = static_cast<std::uint32_t>(names.size());
    const SeedPlan seeds(seed, SeedPurpose::converge, count, runs);
    const SeedPlan pictures(seed, SeedPurpose::converge_picture, count, 1);
    std::vector<Method> methods;
    for (const std::string& name : names) {
        const auto same = [&](const Method& method) { return method.name == name; };
        if (std::any_of(methods.begin(), methods.end(), same)) {
            throw Error(fmt::format("`methods`: {} is named twice", name));
        }
        const auto place = static_cast<std::uint32_t>(methods.size());
        Method method = method_named("`methods`", name, base, seeds, place);
        method.picture_seed = pictures.seed(place, 0);
        methods.push_back(method);
    }
    return methods;
}

Method plan_reference(const std::string& name, const RenderRequest& request, std::uint32_t seed,
                      const std::vector<Method>& methods) {
    RenderRequest base = request;
    base.settings.sampler = SamplerKind::sobol;
    const SeedPlan blocks(seed, SeedPurpose::converge_reference, 1, reference_blocks);
    const auto named = [&](const std::string& text) { return method_named("`reference`", text, base, blocks, 0); };
    if (name != "auto") {
        return named(name);
    }
    std::string first;
    for (const char* backend : {"vulkan", "cpu", "oracle"}) {
        const auto uses = [&](const Method& method) { return method.request.backend == backend; };
        if (std::none_of(methods.begin(), methods.end(), uses)) {
            continue;
        }
        const std::string path = std::string(backend) == "oracle" ? backend : std::string(backend) + ":path";
        first = first.empty() ? path : first;
        const bool taken = std::any_of(methods.begin(), methods.end(), [&](const Method& method) {
            return uses(method) &&
                   (method.request.backend == "oracle" ? method.request.oracle_mode == RenderRequest{}.oracle_mode
                                                       : method.request.settings.integrator == Integrator::path);
        });
        if (!taken) {
            return named(path);
        }
    }
    if (first == "oracle") {
        return named("cpu:path");
    }
    Method method = named(first);
    method.request.settings.mis =
        base.settings.mis == MisHeuristic::power ? MisHeuristic::balance : MisHeuristic::power;
    method.name += fmt::format(" with mis {}", name_of(method.request.settings.mis));
    return method;
}

}  // namespace diptych::core
