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

/// The oracle's modes are its own.
void check_mode(const char* option, const Method& method) {
    if (method.request.backend == "oracle") {
        try {
            oracle_mode_from_name(method.request.oracle_mode);
        } catch (const Error& error) {
            throw Error(fmt::format("{} {}: {}", option, method.name, error.what()));
        }
    }
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
        return [backend](const std::string& name) { return backend_in(name) == backend; };
    };
    const bool vulkan = any(on("vulkan")) || backend_in(options.reference) == "vulkan";
    if (!vulkan && (!request.device.empty() || request.validation)) {
        throw Error(
            fmt::format("{}: works only with a method on vulkan", request.validation ? "--validation" : "--device"));
    }
    if (request.threads != 0 && !any(on("cpu")) && !any(on("oracle"))) {
        throw Error("--threads: works only with a method on cpu or oracle");
    }
    const bool resampled = any([&](const std::string& name) {
        const SeedPlan any_seeds(options.seed, SeedPurpose::converge, 1, 1);
        const Method method = method_named("`methods`", name, request, any_seeds, 0);
        check_mode("`methods`", method);
        return method.request.backend != "oracle" && resamples(method.request.settings.integrator);
    });
    refuse_idle_resampling_options(names, resampled);
    if (options.folder.empty()) {
        throw Error("-o: needs a folder for the results");
    }
}

std::vector<Method> planned_methods(const ConvergeOptions& options) {
    return plan_methods(options.methods, options.arguments.request, options.seed, options.runs);
}

bool reference_is_file(const ConvergeOptions& options) {
    return options.reference != "auto" && !names_method(options.reference);
}

Method planned_reference(const ConvergeOptions& options, const std::vector<Method>& methods) {
    Method reference = plan_reference(options.reference, options.arguments.request, options.seed, methods);
    check_mode("`reference`", reference);
    return reference;
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
        json["reference"] = entry(planned_reference(options, methods));
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
