#include "render/metadata.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "render/request_text.h"
#include "settings/names.h"
#include "settings/ranges.h"

namespace diptych::core {

namespace {

const char* yes_or_no(bool value) {
    return value ? "yes" : "no";
}

}  // namespace

std::map<std::string, std::string> render_metadata(const RenderRequest& request, const RenderOutcome& outcome) {
    const RenderSettings& settings = request.settings;
    std::map<std::string, std::string> metadata;
    const auto add = [&](const std::string& name, const auto& value) { metadata[name] = fmt::format("{}", value); };
    // By the name that the command line and the view have for the setting; empty where the scene's own counts.
    const auto add_number = [&](const SettingRange& range, const auto& value) { add(key_of(range.name), value); };
    const auto add_optional = [&](const SettingRange& range, const std::optional<double>& value) {
        add_number(range, value ? fmt::format("{}", *value) : std::string());
    };
    add("program", outcome.maker.program);
    if (outcome.maker.command) {
        add("command", outcome.maker.command(request, outcome.spp));
    }
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
        add("light_sampler", name_of(settings.light_sampler));
        add("generic", yes_or_no(settings.generic));
        add("warm_up", request.warm_up);
        add("correlated", yes_or_no(reuses(settings.integrator)));
        if (resamples(settings.integrator)) {
            const ResamplingSettings& resampling = settings.resampling;
            add_number(ranges::candidates, resampling.light_candidates);
            add_number(ranges::near_share, resampling.near_share);
            add("bsdf_candidate", yes_or_no(resampling.bsdf_candidate));
            add("temporal", yes_or_no(resampling.temporal));
            add_number(ranges::spatial_passes, resampling.spatial_passes);
            add_number(ranges::neighbors, resampling.neighbors);
            add_number(ranges::reuse_radius, resampling.radius);
            add_number(ranges::confidence_cap, resampling.confidence_cap);
            add("reuse_mis", name_of(resampling.mis));
            add("reuse_visibility", name_of(resampling.visibility));
            add("atlas", settings.atlas_tile);
        }
    }
    add("spp", outcome.spp);
    add("samples", outcome.samples.text());
    add("fingerprint", outcome.fingerprint);
    add("standard_error", yes_or_no(settings.standard_error));
    add("first_hit_layers", yes_or_no(settings.first_hit_layers));
    add("width", settings.width);
    add("height", settings.height);
    add_number(ranges::max_depth, settings.max_depth);
    add("seed", settings.seed);
    add("brdf", name_of(settings.brdf));
    add("normal_maps", name_of(settings.normal_maps));
    add("clip", request.clip);
    add("camera", request.camera);
    add("camera_index", settings.camera);
    add("env", used_environment(request));
    add_number(ranges::env_scale, request.environment_scale);
    add_number(ranges::env_rotate, request.environment_rotation);
    add("eye", triple(request.viewpoint.eye));
    add("look_at", triple(request.viewpoint.look_at));
    add("up", triple(request.viewpoint.up));
    add_optional(ranges::fov, request.viewpoint.fov);
    add_optional(ranges::view_height, request.viewpoint.view_height);
    add("sun", sun_text(request.sun));
    add_optional(ranges::aperture, request.lens.radius);
    add_optional(ranges::focus, request.lens.focus_distance);
    if (request.frames > 0) {
        add("frame", request.frame);
        add("time", shown_at(request));
        add("fps", request.fps);
        add("orbit", request.orbit);
    }
    add_number(ranges::exposure, request.exposure);
    add("tonemap", request.tonemap);
    add("interrupted", yes_or_no(outcome.interrupted));
    add("uneven", yes_or_no(outcome.uneven));
    add("uneven_from", outcome.uneven ? fmt::format("{}", outcome.uneven_from) : "");
    add("look_at", outcome.look_at > 0 ? fmt::format("{}", outcome.look_at) : "");
    add("seconds", outcome.seconds);
    add("rays", outcome.rays);
    add("nonfinite", outcome.nonfinite);
    return metadata;
}

}  // namespace diptych::core
