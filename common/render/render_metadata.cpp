#include "render/render_metadata.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "render/settings_names.h"

namespace diptych {

namespace {

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

const char* yes_or_no(bool value) {
    return value ? "yes" : "no";
}

}  // namespace

std::string repeat_command(const RenderRequest& request, std::uint32_t spp) {
    const RenderSettings& settings = request.settings;
    std::string command = "diptych render " + shell_quoted(request.scene);
    const auto add = [&](const char* option, const auto& value) {
        command += fmt::format(" {} {}", option, shell_quoted(fmt::format("{}", value)));
    };
    for (const std::string& extension : request.ignored_extensions) {
        add("--ignore-extension", extension);
    }
    add("-o", request.output);
    add("--backend", request.backend);
    if (!request.device.empty()) {
        add("--device", request.device);
    }
    const bool oracle = request.backend == "oracle";  // which is told by mode, and has no sampler or weights
    if (oracle) {
        add("--oracle-mode", request.oracle_mode);
    } else {
        add("--integrator", name_of(settings.integrator));
    }
    add("--spp", spp);
    add("--size", fmt::format("{}x{}", settings.width, settings.height));
    add("--max-depth", settings.max_depth);
    add("--seed", settings.seed);
    add("--brdf", name_of(settings.brdf));
    if (!oracle) {
        add("--sampler", name_of(settings.sampler));
        add("--mis", name_of(settings.mis));
    }
    if (!oracle && settings.sampler == SamplerKind::hammersley) {
        add("--sample-count", settings.sample_count);
    }
    if (!oracle && (settings.integrator == Integrator::ris || settings.integrator == Integrator::restir)) {
        const ResamplingSettings& resampling = settings.resampling;
        add("--candidates", resampling.light_candidates);
        command += resampling.bsdf_candidate ? " --bsdf-candidate" : " --no-bsdf-candidate";
        command += resampling.temporal ? " --temporal" : " --no-temporal";
        add("--spatial-passes", resampling.spatial_passes);
        add("--neighbors", resampling.neighbors);
        add("--reuse-radius", resampling.radius);
        add("--confidence-cap", resampling.confidence_cap);
        add("--reuse-mis", name_of(resampling.mis));
        add("--reuse-visibility", name_of(resampling.visibility));
        add("--atlas", settings.atlas_tile);
    }
    if (!request.camera.empty()) {
        add("--camera", request.camera);
    }
    if (!request.environment.empty()) {
        add("--env", request.environment);
    }
    if (request.environment_scale != 1) {
        add("--env-scale", request.environment_scale);
    }
    if (request.environment_rotation != 0) {
        add("--env-rotate", request.environment_rotation);
    }
    if (request.lens_radius) {
        add("--aperture", *request.lens_radius);
    }
    if (request.focus_distance) {
        add("--focus", *request.focus_distance);
    }
    if (request.frames > 0) {
        add("--frames", request.frames);
        add("--fps", request.fps);
        add("--start", request.start);
    }
    if (request.orbit != 0) {
        add("--orbit", request.orbit);
    }
    add("--exposure", request.exposure);
    add("--tonemap", request.tonemap);
    command += settings.standard_error ? " --layers" : " --no-layers";
    command += settings.generic ? " --generic" : "";
    return command;
}

std::map<std::string, std::string> render_metadata(const RenderRequest& request, const RenderOutcome& outcome) {
    const RenderSettings& settings = request.settings;
    std::map<std::string, std::string> metadata;
    const auto add = [&](const char* name, const auto& value) { metadata[name] = fmt::format("{}", value); };
    add("program", outcome.program);
    add("command", repeat_command(request, outcome.spp));
    add("scene", request.scene);
    add("ignored_extensions", fmt::format("{}", fmt::join(request.ignored_extensions, ",")));
    add("backend", request.backend);
    add("device", outcome.device);
    if (request.backend == "oracle") {
        add("oracle_mode", request.oracle_mode);
    } else {
        add("integrator", name_of(settings.integrator));
        add("sampler", name_of(settings.sampler));
        add("sample_count", settings.sample_count);
        add("mis", name_of(settings.mis));
        add("generic", yes_or_no(settings.generic));
    }
    add("spp", outcome.spp);
    add("width", settings.width);
    add("height", settings.height);
    add("max_depth", settings.max_depth);
    add("seed", settings.seed);
    add("brdf", name_of(settings.brdf));
    add("camera", request.camera);
    add("camera_index", settings.camera);
    add("environment", request.environment);
    add("environment_scale", request.environment_scale);
    add("environment_rotation", request.environment_rotation);
    add("lens_radius", request.lens_radius ? fmt::format("{}", *request.lens_radius) : "");
    add("focus_distance", request.focus_distance ? fmt::format("{}", *request.focus_distance) : "");
    if (request.frames > 0) {
        add("frame", request.frame);
        add("time", request.start);
        add("fps", request.fps);
        add("orbit", request.orbit);
    }
    add("exposure", request.exposure);
    add("tonemap", request.tonemap);
    add("interrupted", yes_or_no(outcome.interrupted));
    add("uneven", yes_or_no(outcome.uneven));
    add("seconds", outcome.seconds);
    add("rays", outcome.rays);
    add("nonfinite", outcome.nonfinite);
    return metadata;
}

}  // namespace diptych
