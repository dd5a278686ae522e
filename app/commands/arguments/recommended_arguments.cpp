#include "commands/arguments/recommended_arguments.h"

#include <fmt/format.h>

#include "random_scene/scene_files.h"
#include "settings/names.h"

namespace diptych::core::app {

namespace {

std::string sky_arguments(const RandomScene& random, const std::filesystem::path& path) {
    const Environment& sky = random.scene.environment;
    switch (sky.kind) {
    case EnvironmentKind::map:
        return fmt::format(" --env {} --env-scale {} --env-rotate {}", random_sky_path(path).string(), sky.scale.x,
                           random.sky_degrees);
    case EnvironmentKind::constant:
        return fmt::format(" --env {},{},{}", sky.scale.x, sky.scale.y, sky.scale.z);
    default:
        return " --env none";
    }
}

std::string resampling_arguments(const ResamplingSettings& s) {
    return fmt::format(
        " --candidates {} --near-share {}{}{} --spatial-passes {} --neighbors {} --reuse-radius {} --confidence-cap {}"
        " --reuse-mis {} --reuse-visibility {}",
        s.light_candidates, s.near_share, s.bsdf_candidate ? "" : " --no-bsdf-candidate",
        s.temporal ? "" : " --no-temporal", s.spatial_passes, s.neighbors, s.radius, s.confidence_cap, name_of(s.mis),
        name_of(s.visibility));
}

}  // namespace

std::string recommended_arguments(const RecommendedSettings& settings) {
    std::string out = settings.environment.empty() ? "" : "--env " + settings.environment;
    if (settings.max_depth) {
        out += fmt::format("{}--max-depth {}", out.empty() ? "" : " ", *settings.max_depth);
    }
    return out;
}

std::string recommended_arguments(const RandomScene& random, const std::filesystem::path& path) {
    const RenderSettings& s = random.settings;
    const Camera& camera = random.scene.cameras[std::size_t(s.camera)];
    std::string out = fmt::format(
        "--size {}x{} --camera {} --integrator {} --brdf {} --normal-maps {} --sampler {} --mis {}"
        " --light-sampler {} --max-depth {}{}",
        s.width, s.height, camera.name, name_of(s.integrator), name_of(s.brdf), name_of(s.normal_maps),
        name_of(s.sampler), name_of(s.mis), name_of(s.light_sampler), s.max_depth, s.generic ? " --generic" : "");
    if (random.frames > 0) {
        out += fmt::format(" --frames {} --fps {}", random.frames, random_fps);
    }
    out += sky_arguments(random, path);
    if (camera.lens.radius > 0) {
        out += fmt::format(" --aperture {} --focus {}", camera.lens.radius, camera.lens.focus_distance);
    }
    return out + (resamples(s.integrator) ? resampling_arguments(s.resampling) : "");
}

}  // namespace diptych::core::app
