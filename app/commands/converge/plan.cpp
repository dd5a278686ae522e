#include "commands/converge/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "digest.h"
#include "error.h"
#include "image/atomic_file.h"
#include "input_file.h"
#include "oracle_renderer/oracle_renderer.h"
#include "console/repeat_command.h"
#include "settings/names.h"
#include "console/report.h"
#include "commands/verify/report.h"

namespace diptych::core::app {

namespace {

namespace fs = std::filesystem;

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

bool is_backend(const std::string& name) {
    return name == "cpu" || name == "vulkan" || name == "oracle";
}

Method parse_method(const char* option, const std::string& text, const RenderRequest& base, const SeedPlan& seeds,
                    std::uint32_t place) {
    const std::vector<std::string> parts = parts_of(text);
    const std::string& backend = parts.front();
    if (!is_backend(backend)) {
        throw Error(
            fmt::format("{} {}: expected BACKEND:INTEGRATOR; the backends are cpu, vulkan, oracle", option, text));
    }
    const bool oracle = backend == "oracle";
    if (parts.size() > (oracle ? 2U : 3U) || (!oracle && parts.size() < 2)) {
        throw Error(
            fmt::format("{} {}: expected cpu:INTEGRATOR[:SAMPLER], vulkan:INTEGRATOR[:SAMPLER] or oracle[:MODE]",
                        option, text));
    }
    Method method{.name = text, .request = base, .seeds = seeds, .place = place};
    method.request.settings.seed = method.seed_of(0);
    method.request.backend = backend;
    if (backend == "vulkan") {
        method.request.threads = 0;
    } else {
        method.request.device.clear();
        method.request.validation = false;
    }
    try {
        if (oracle) {
            method.request.oracle_mode = parts.size() > 1 ? parts[1] : RenderRequest{}.oracle_mode;
            oracle_mode_from_name(method.request.oracle_mode);
            method.request.settings.integrator = Integrator::path;
        } else {
            method.request.settings.integrator = integrator_from_name(parts[1]);
            if (parts.size() > 2) {
                method.request.settings.sampler = sampler_from_name(parts[2]);
            }
        }
    } catch (const Error& error) {
        throw Error(fmt::format("{} {}: {}", option, text, error.what()));
    }
    return method;
}

std::string digest(const std::string& path) {
    require_input(path);
    std::ifstream file(path, std::ios::binary);
    std::uint64_t hash = digest_of({});
    for (std::istreambuf_iterator<char> byte(file), end; byte != end; ++byte) {
        const auto value = static_cast<unsigned char>(*byte);
        hash = digest_of({&value, 1}, hash);
    }
    return fmt::format("{:016x}", hash);
}

/// A name for what differs, and both values where they are short.
std::string first_difference(const nlohmann::ordered_json& was, const nlohmann::ordered_json& is) {
    for (const auto& [key, value] : is.items()) {
        const nlohmann::ordered_json old = was.value(key, nlohmann::ordered_json());
        if (old == value) {
            continue;
        }
        if (value.is_structured()) {
            return fmt::format("other {}", key);
        }
        return fmt::format("{} was {}, is {}", key, old.dump(), value.dump());
    }
    return "it has entries that are unknown here";
}

}  // namespace

void check_converge_options(ConvergeOptions& options) {
    RenderArguments names = options.arguments;
    names.request.device.clear();
    names.request.threads = 0;
    names.request.validation = false;
    resolve_names(names);
    options.arguments.request.settings = names.request.settings;
    RenderSettings& settings = options.arguments.request.settings;
    settings.seed = options.seed;
    const auto any = [&](const auto& holds) {
        return std::any_of(options.methods.begin(), options.methods.end(), holds);
    };
    const RenderRequest& request = options.arguments.request;
    const auto on = [](const char* backend) {
        return [backend](const std::string& name) { return parts_of(name).front() == backend; };
    };
    const bool vulkan = any(on("vulkan")) || parts_of(options.reference).front() == "vulkan";
    if (!vulkan && (!request.device.empty() || request.validation)) {
        throw Error(
            fmt::format("{}: works only with a method on vulkan", request.validation ? "--validation" : "--device"));
    }
    if (request.threads != 0 && !any(on("cpu")) && !any(on("oracle"))) {
        throw Error("--threads: works only with a method on cpu or oracle");
    }
    const bool resampled = any([&](const std::string& name) {
        const SeedPlan any_seeds(options.seed, SeedPurpose::converge, 1, 1);
        const Method method = parse_method("--methods", name, request, any_seeds, 0);
        return method.request.backend != "oracle" && resamples(method.request.settings.integrator);
    });
    refuse_idle_resampling_options(names, resampled);
    if (options.folder.empty()) {
        throw Error("-o: needs a folder for the results");
    }
}

std::vector<Method> plan_methods(const ConvergeOptions& options) {
    const auto count = static_cast<std::uint32_t>(options.methods.size());
    const SeedPlan runs(options.seed, SeedPurpose::converge, count, options.runs);
    const SeedPlan pictures(options.seed, SeedPurpose::converge_picture, count, 1);
    std::vector<Method> methods;
    for (const std::string& name : options.methods) {
        const auto same = [&](const Method& method) { return method.name == name; };
        if (std::any_of(methods.begin(), methods.end(), same)) {
            throw Error(fmt::format("--methods: {} is named twice", name));
        }
        const auto place = static_cast<std::uint32_t>(methods.size());
        Method method = parse_method("--methods", name, options.arguments.request, runs, place);
        method.picture_seed = pictures.seed(place, 0);
        methods.push_back(method);
    }
    return methods;
}

bool reference_is_file(const ConvergeOptions& options) {
    return options.reference != "auto" && !is_backend(parts_of(options.reference).front());
}

Method plan_reference(const ConvergeOptions& options, const std::vector<Method>& methods) {
    RenderRequest base = options.arguments.request;
    base.settings.sampler = SamplerKind::sobol;
    const SeedPlan blocks(options.seed, SeedPurpose::converge_reference, 1, reference_blocks);
    const auto parse = [&](const std::string& text) { return parse_method("--reference", text, base, blocks, 0); };
    if (options.reference != "auto") {
        return parse(options.reference);
    }
    std::string first;
    for (const char* backend : {"vulkan", "cpu", "oracle"}) {
        const auto uses = [&](const Method& method) { return method.request.backend == backend; };
        if (std::none_of(methods.begin(), methods.end(), uses)) {
            continue;
        }
        const std::string name = std::string(backend) == "oracle" ? backend : std::string(backend) + ":path";
        first = first.empty() ? name : first;
        const bool taken = std::any_of(methods.begin(), methods.end(), [&](const Method& method) {
            return uses(method) &&
                   (method.request.backend == "oracle" ? method.request.oracle_mode == RenderRequest{}.oracle_mode
                                                       : method.request.settings.integrator == Integrator::path);
        });
        if (!taken) {
            return parse(name);
        }
    }
    if (first == "oracle") {
        return parse("cpu:path");
    }
    Method method = parse(first);
    method.request.settings.mis =
        base.settings.mis == MisHeuristic::power ? MisHeuristic::balance : MisHeuristic::power;
    method.name += fmt::format(" with --mis {}", name_of(method.request.settings.mis));
    return method;
}

nlohmann::ordered_json plan_to_json(const ConvergeOptions& options, const std::vector<Method>& methods) {
    const auto entry = [](const Method& method) {
        return nlohmann::ordered_json{{"method", method.name}, {"command", repeat_command(method.request, 0)}};
    };
    nlohmann::ordered_json json;
    json["program"] = program_version();
    json["scene"] = options.arguments.request.scene;
    json["scene_digest"] = digest(options.arguments.request.scene);
    json["width"] = options.arguments.request.settings.width;
    json["height"] = options.arguments.request.settings.height;
    json["seed"] = options.seed;
    json["runs"] = options.runs;
    json["spp_max"] = options.seconds > 0 ? nlohmann::ordered_json() : nlohmann::ordered_json(options.spp_max);
    json["time"] = options.seconds > 0 ? nlohmann::ordered_json(options.seconds) : nlohmann::ordered_json();
    json["methods"] = nlohmann::ordered_json::array();
    for (const Method& method : methods) {
        json["methods"].push_back(entry(method));
    }
    if (reference_is_file(options)) {
        json["reference"] = options.reference;
        json["reference_digest"] = digest(options.reference);
    } else {
        json["reference"] = entry(plan_reference(options, methods));
    }
    return json;
}

namespace {

FileLock lock_folder(const std::string& folder) {
    prepare_folder(folder);
    FileLock lock(fs::path(folder) / ".lock");
    if (!lock.held()) {
        throw Error(fmt::format("{}: another converge measures into this folder; wait for its end, or give another -o",
                                folder));
    }
    return lock;
}

}  // namespace

FileLock claim_folder(const ConvergeOptions& options, const nlohmann::ordered_json& plan) {
    FileLock lock = lock_folder(options.folder);
    const fs::path path = fs::path(options.folder) / "plan.json";
    if (!fs::exists(path)) {
        if (fs::exists(fs::path(options.folder) / "results.jsonl")) {
            throw Error(fmt::format(
                "{}: holds results.jsonl, but not the plan.json that they came from; give another -o", options.folder));
        }
        write_file_atomically(path, plan.dump(2) + "\n");
        return lock;
    }
    require_input(path);
    std::ifstream file(path);
    const nlohmann::ordered_json was = nlohmann::ordered_json::parse(file, nullptr, false);
    if (was.is_discarded() || !was.is_object()) {
        throw Error(fmt::format("{}: is not JSON; give another -o", path.string()));
    }
    if (was != plan) {
        throw Error(fmt::format("{}: holds results of another plan ({}); give another -o, or remove it", options.folder,
                                first_difference(was, plan)));
    }
    return lock;
}

}  // namespace diptych::core::app
