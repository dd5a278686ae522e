#include "commands/arguments/arguments.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "error.h"
#include "memory_budget.h"
#include "console/report.h"
#include "oracle_renderer/oracle_renderer.h"
#include "session/scene_setup.h"
#include "settings/names.h"

namespace diptych::core::app {

namespace {

constexpr int largest_film_side = 32768;
constexpr long long largest_area = 1LL << 28;

[[noreturn]] void refuse_size(const std::string& text, const std::string& reason) {
    throw Error(fmt::format("--size {}: {}", text, reason));
}

int parse_side(const std::string& text, const std::string& side) {
    int value = 0;
    const char* end = side.data() + side.size();
    const auto [stop, failure] = std::from_chars(side.data(), end, value);
    if (failure != std::errc() || stop != end || value < 1 || value > largest_film_side) {
        refuse_size(text, fmt::format("expected WIDTHxHEIGHT or a height in pixels, each from 1 to {}",
                                      largest_film_side));
    }
    return value;
}

/// What is no number at all is left to the option's own conversion.
CLI::Validator number_that(const std::string& is, const std::function<bool(double)>& holds) {
    const auto reason = [is, holds](const std::string& text) {
        double value = 0;
        const bool passes = !CLI::detail::lexical_cast(text, value) || holds(value);
        return passes ? std::string() : fmt::format("{} is not {}", text, is);
    };
    return {reason, ""};
}

}  // namespace

CLI::Validator finite_number() {
    return number_that("a finite number", [](double x) { return std::isfinite(x); });
}

CLI::Validator positive_number() {
    return number_that("a positive number", [](double x) { return std::isfinite(x) && x > 0; });
}

CLI::Validator non_negative_number() {
    return number_that("a number from 0 up", [](double x) { return std::isfinite(x) && x >= 0; });
}

CLI::Validator number_between(double least, double most) {
    return number_that(fmt::format("a number from {} to {}", least, most),
                       [least, most](double x) { return x >= least && x <= most; });
}

CLI::Validator accepted_by(const SettingRange& range) {
    const auto [least, most] = range.accepted;
    if (most < ranges::unlimited) {
        return number_between(least, most).description(fmt::format("in [{} - {}]", least, most));
    }
    return least > 0 ? positive_number() : least == 0 ? non_negative_number() : finite_number();
}

std::string option_of(const SettingRange& range) {
    return std::string("--") + range.option();
}

void add_display_options(CLI::App& command, double& exposure, std::string& tonemap, const char* of) {
    command.add_option(option_of(ranges::exposure), exposure, fmt::format("Exposure in EV (a factor of 2^EV), {}", of))
        ->check(accepted_by(ranges::exposure))
        ->capture_default_str();
    command
        .add_option("--tonemap", tonemap,
                    fmt::format("Tone mapping, {}: none, exponential, uncharted2, aces or pbr-neutral", of))
        ->capture_default_str();
}

void add_memory_option(CLI::App& command, std::uint64_t& limit) {
    const auto problem = [](const std::string& text) {
        try {
            memory_from_text(text);
            return std::string();
        } catch (const Error& error) {
            return std::string(error.what());
        }
    };
    command
        .add_option_function<std::string>(
            "--memory-limit", [&limit](const std::string& text) { limit = memory_from_text(text); },
            "Memory that an input file may ask for, such as 500M or 2G; default: a quarter of the machine's, or of its "
            "container's")
        ->check(CLI::Validator(problem, ""))
        ->type_name("SIZE");
}

void add_integrator_option(CLI::App& command, RenderArguments& arguments) {
    arguments.panel_options.push_back(
        command
            .add_option("--integrator", arguments.integrator,
                        "Integrator: brdf, direct, path, ris or restir; the oracle has none")
            ->capture_default_str());
}

void add_scene_options(CLI::App& command, RenderArguments& arguments) {
    RenderRequest& request = arguments.request;
    command.add_option("--brdf", arguments.brdf, "Microfacet model: ggx or blinn-phong")->capture_default_str();
    command
        .add_option("--normal-maps", arguments.normal_maps,
                    "Normal mapping: shading (tilts the shading normal) or microfacet (facets that conserve energy)")
        ->capture_default_str();
    arguments.panel_options.push_back(
        command.add_option("--sampler", arguments.sampler, "Sample sequence: independent, hammersley or sobol")
            ->capture_default_str());
    arguments.panel_options.push_back(
        command.add_option("--mis", arguments.mis, "MIS heuristic of path: power or balance")->capture_default_str());
    arguments.panel_options.push_back(
        command
            .add_option("--light-sampler", arguments.light_sampler,
                        "How path and direct pick a light: uniform, power or spatial (also by distance and direction)")
            ->capture_default_str());
    command
        .add_option(option_of(ranges::max_depth), request.settings.max_depth,
                    "Maximum number of scattering events; 1 gives emission and direct light")
        ->check(accepted_by(ranges::max_depth))
        ->capture_default_str();
    command.add_option("--size", arguments.size,
                       "Image size, WIDTHxHEIGHT in pixels; a height alone takes the width from the camera's aspect");
    command.add_option("--camera", request.camera, "Camera, by name or index; default: the first");
    command.add_option("--clip", request.clip,
                       "Animation to play, by name or index (see info); default: all, the first one for each node");
    command.add_option("--env", request.environment,
                       "Environment: none, neutral, R,G,B radiance, or a .hdr or .exr panorama (or FILE:LAYER); "
                       "default: neutral if the scene would be black");
    const auto add = [&](const SettingRange& range, auto& value, const char* help) {
        command.add_option(option_of(range), value, help)->check(accepted_by(range));
    };
    add(ranges::env_scale, request.environment_scale, "Factor on the radiance of the environment");
    add(ranges::env_rotate, request.environment_rotation, "Rotation of the environment about +Y, degrees");
    add(ranges::aperture, request.lens.radius, "Lens radius, metres; 0 is a pinhole");
    add(ranges::focus, request.lens.focus_distance, "Focus distance, metres");
    add_viewpoint_options(command, arguments);
    command
        .add_option("--ignore-extension", request.ignored_extensions,
                    "Ignore this glTF extension, even if the file requires it; may be repeated")
        ->type_name("NAME")
        ->allow_extra_args(false);
    command.add_flag("--allow-external", request.allow_external,
                     "Also read buffers and textures outside the scene file's folder");
    add_memory_option(command, request.memory_limit);
    command.add_flag("--strict", request.strict,
                     "Refuse a scene file with faults or with parts that cannot be shown, instead of warning");
    arguments.panel_options.push_back(
        command.add_flag("--generic", request.settings.generic,
                         "Also keep the features that the scene does not need; the image is the same"));
    add_resampling_options(command, arguments);
}

void add_backend_options(CLI::App& command, RenderArguments& arguments) {
    RenderRequest& request = arguments.request;
    command.add_option("--backend", request.backend, "Backend: cpu, vulkan or oracle")->capture_default_str();
    command.add_option("--device", request.device, "Vulkan device, by index or name; default: the best");
    command.add_option("--threads", request.threads, "Threads of cpu or oracle; default: one per core")
        ->check(CLI::Range(1, 4096));
    command.add_flag("--validation", request.validation,
                     "Run Vulkan's validation layers; exit code 1 if they report anything");
    // For measuring what it gains (docs/decisions/0010-groups-of-instances.md): not in the help.
    command.add_flag("--group-instances,!--no-group-instances", request.group_instances)->group("");
}

void add_oracle_option(CLI::App& command, RenderArguments& arguments) {
    arguments.oracle_option =
        command
            .add_option("--oracle-mode", arguments.request.oracle_mode,
                        "Sampling strategy of the oracle: mis, bsdf, hemisphere or area; it has no --integrator")
            ->capture_default_str();
}

void resolve_oracle_mode(const RenderArguments& arguments) {
    oracle_mode_from_name(arguments.request.oracle_mode);
    if (arguments.request.backend != "oracle") {
        if (arguments.oracle_option->count() > 0) {
            throw Error("--oracle-mode: works only with --backend oracle");
        }
        return;
    }
    for (const CLI::Option* option : arguments.panel_options) {
        if (option->count() > 0) {
            throw Error(fmt::format("{}: does not apply to --backend oracle, which has only --oracle-mode",
                                    option->get_name()));
        }
    }
}

void resolve_names(RenderArguments& arguments) {
    RenderRequest& request = arguments.request;
    RenderSettings& settings = request.settings;
    settings.integrator = integrator_from_name(arguments.integrator);
    settings.brdf = brdf_from_name(arguments.brdf);
    settings.normal_maps = normal_maps_from_name(arguments.normal_maps);
    settings.sampler = sampler_from_name(arguments.sampler);
    settings.mis = mis_from_name(arguments.mis);
    settings.light_sampler = light_sampler_from_name(arguments.light_sampler);
    resolve_resampling_names(arguments);
    if (request.backend != "cpu" && request.backend != "vulkan" && request.backend != "oracle") {
        throw Error(fmt::format("--backend {}: there are only cpu, vulkan, oracle", request.backend));
    }
    const bool cpu = request.backend != "vulkan";
    if (cpu && !request.device.empty()) {
        throw Error("--device: works only with --backend vulkan");
    }
    if (cpu && request.validation) {
        throw Error("--validation: works only with --backend vulkan");
    }
    if (!cpu && request.threads != 0) {
        throw Error("--threads: works only with --backend cpu or oracle");
    }
    if (!arguments.size.empty()) {
        resolve_size(arguments, Camera{});
    }
}

void resolve_size(RenderArguments& arguments, const Camera& camera) {
    RenderSettings& settings = arguments.request.settings;
    const std::string& text = arguments.size;
    const std::size_t cross = text.find('x');
    if (cross != std::string::npos) {
        settings.width = parse_side(text, text.substr(0, cross));
        settings.height = parse_side(text, text.substr(cross + 1));
    } else {
        settings.height = text.empty() ? RenderSettings{}.height : parse_side(text, text);
        const double width = std::round(settings.height * camera.aspect.value_or(1));
        settings.width = static_cast<int>(std::clamp<double>(width, 1, largest_film_side));
    }
    if (static_cast<long long>(settings.width) * settings.height > largest_area) {
        refuse_size(text, fmt::format("has more than {} pixels", largest_area));
    }
}

Scene prepare_scene(RenderArguments& arguments) {
    Scene scene = place_requested(arguments.request);
    resolve_size(arguments, scene.cameras[static_cast<std::size_t>(arguments.request.settings.camera)]);
    report_warnings(scene.warnings);
    return scene;
}

}  // namespace diptych::core::app
