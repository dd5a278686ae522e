#include "console/repeat_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "console/report.h"
#include "render/request_text.h"
#include "settings/names.h"
#include "settings/ranges.h"

namespace diptych::core::app {

std::string shell_quoted(const std::string& word) {
    const auto plain = [](unsigned char c) {
        return std::isalnum(c) != 0 || std::string("-_./,:+=@%").find(static_cast<char>(c)) != std::string::npos;
    };
    if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) {
        return word;
    }
    std::string quoted = "'";
    for (const char c : word) {
        quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    }
    return quoted + "'";
}

namespace {

template <class Value>
void add_option(std::string& command, const std::string& option, const Value& value) {
    command += fmt::format(" {} {}", option, shell_quoted(fmt::format("{}", value)));
}

template <class Value>
void add_option(std::string& command, const SettingRange& range, const Value& value) {
    add_option(command, std::string("--") + range.name, value);
}

void add_viewpoint_options(std::string& command, const RenderRequest& request) {
    const Viewpoint& viewpoint = request.viewpoint;
    const auto add = [&](const char* option, const std::string& value) {
        if (!value.empty()) {
            add_option(command, option, value);
        }
    };
    add("--eye", triple(viewpoint.eye));
    add("--look-at", triple(viewpoint.look_at));
    add("--up", triple(viewpoint.up));
    add("--fov", viewpoint.fov ? fmt::format("{}", *viewpoint.fov) : "");
    add("--view-height", viewpoint.view_height ? fmt::format("{}", *viewpoint.view_height) : "");
    add("--sun", sun_text(request.sun));
}

void add_resampling_options(std::string& command, const RenderSettings& settings) {
    const ResamplingSettings& resampling = settings.resampling;
    add_option(command, ranges::candidates, resampling.light_candidates);
    add_option(command, ranges::near_share, resampling.near_share);
    command += resampling.bsdf_candidate ? " --bsdf-candidate" : " --no-bsdf-candidate";
    command += resampling.temporal ? " --temporal" : " --no-temporal";
    add_option(command, ranges::spatial_passes, resampling.spatial_passes);
    add_option(command, ranges::neighbors, resampling.neighbors);
    add_option(command, ranges::reuse_radius, resampling.radius);
    add_option(command, ranges::confidence_cap, resampling.confidence_cap);
    add_option(command, "--reuse-mis", name_of(resampling.mis));
    add_option(command, "--reuse-visibility", name_of(resampling.visibility));
    add_option(command, "--atlas", settings.atlas_tile);
}

/// All that decides which picture it is, but for the integrator.
void add_picture_options(std::string& command, const RenderRequest& request) {
    const RenderSettings& settings = request.settings;
    add_option(command, "--size", fmt::format("{}x{}", settings.width, settings.height));
    add_option(command, ranges::max_depth, settings.max_depth);
    add_option(command, "--seed", settings.seed);
    add_option(command, "--brdf", name_of(settings.brdf));
    add_option(command, "--normal-maps", name_of(settings.normal_maps));
    const bool oracle = request.backend == "oracle";  // which has no sampler or weights
    if (!oracle) {
        add_option(command, "--sampler", name_of(settings.sampler));
        add_option(command, "--mis", name_of(settings.mis));
        add_option(command, "--light-sampler", name_of(settings.light_sampler));
    }
    if (!oracle && settings.sampler == SamplerKind::hammersley) {
        add_option(command, "--sample-count", settings.sample_count);
    }
    if (!oracle && resamples(settings.integrator)) {
        add_resampling_options(command, settings);
    }
    if (!request.camera.empty()) {
        add_option(command, "--camera", request.camera);
    }
    if (const std::string environment = used_environment(request); !environment.empty()) {
        add_option(command, "--env", environment);
    }
    if (request.environment_scale != 1) {
        add_option(command, ranges::env_scale, request.environment_scale);
    }
    if (request.environment_rotation != 0) {
        add_option(command, ranges::env_rotate, request.environment_rotation);
    }
    add_viewpoint_options(command, request);
    if (request.lens.radius) {
        add_option(command, ranges::aperture, *request.lens.radius);
    }
    if (request.lens.focus_distance) {
        add_option(command, ranges::focus, *request.lens.focus_distance);
    }
}

}  // namespace

std::string repeat_command(const RenderRequest& request, std::uint32_t spp) {
    const RenderSettings& settings = request.settings;
    std::string command = "diptych render " + shell_quoted(request.scene);
    for (const std::string& extension : request.ignored_extensions) {
        add_option(command, "--ignore-extension", extension);
    }
    command += request.allow_external ? " --allow-external" : "";
    if (request.memory_limit > 0) {
        add_option(command, "--memory-limit", request.memory_limit);
    }
    add_option(command, "-o", request.output);
    add_option(command, "--backend", request.backend);
    if (!request.device.empty()) {
        add_option(command, "--device", request.device);
    }
    if (request.backend == "oracle") {
        add_option(command, "--oracle-mode", request.oracle_mode);
    } else {
        add_option(command, "--integrator", name_of(settings.integrator));
    }
    if (request.samples) {
        add_option(command, "--samples", range_text({request.samples->first, request.samples->first + spp}));
    } else {
        add_option(command, "--spp", spp);
    }
    add_picture_options(command, request);
    if (!request.clip.empty()) {
        add_option(command, "--clip", request.clip);
    }
    if (request.frames > 0) {
        add_option(command, "--frames", request.frames);
        add_option(command, "--fps", request.fps);
        add_option(command, "--start", request.start);
    }
    if (request.warm_up > 0) {
        add_option(command, "--warm-up", request.warm_up);
    }
    if (request.orbit != 0) {
        add_option(command, "--orbit", request.orbit);
    }
    add_option(command, ranges::exposure, request.exposure);
    add_option(command, "--tonemap", request.tonemap);
    command += settings.first_hit_layers ? " --layers" : " --no-layers";
    command += settings.generic ? " --generic" : "";
    return command;
}

std::string replay_command(const RenderRequest& request, const shared::PathQuery& path) {
    const RenderSettings& settings = request.settings;
    std::string command = "diptych replay " + shell_quoted(request.scene);
    for (const std::string& extension : request.ignored_extensions) {
        add_option(command, "--ignore-extension", extension);
    }
    command += request.allow_external ? " --allow-external" : "";
    if (request.memory_limit > 0) {
        add_option(command, "--memory-limit", request.memory_limit);
    }
    add_option(command, "--pixel", fmt::format("{},{}", path.pixel.x, path.pixel.y));
    add_option(command, "--sample", path.sample_index);
    add_option(command, "--integrator", name_of(settings.integrator));
    add_picture_options(command, request);
    command += settings.generic ? " --generic" : "";
    return command;
}

PictureMaker this_program() {
    return {program_version(), repeat_command};
}

}  // namespace diptych::core::app
