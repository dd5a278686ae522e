#include "random_scene/scene_files.h"

#include <fmt/format.h>

#include <algorithm>

#include "error.h"
#include "image/image_file.h"
#include "settings/names.h"
#include "scene/environment_load.h"
#include "gltf/import.h"
#include "gltf/write.h"

namespace diptych::core {

namespace {

std::filesystem::path sky_path(const std::filesystem::path& path) {
    return path.parent_path() / (path.stem().string() + "-sky.exr");
}

void write_sky(const Environment& sky, const std::filesystem::path& path) {
    Image image = make_image(sky.width, sky.height, 3);
    for (std::size_t i = 0; i < sky.texels.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            image.data[3 * i + std::size_t(c)] = sky.texels[i][c];
        }
    }
    write_exr_channels(path, image, {"R", "G", "B"}, {});
}

std::string sky_arguments(const RandomScene& random, const std::filesystem::path& path) {
    const Environment& sky = random.scene.environment;
    switch (sky.kind) {
    case EnvironmentKind::map:
        return fmt::format(" --env {} --env-scale {} --env-rotate {}", sky_path(path).string(), sky.scale.x,
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

/// Cameras that hang in nodes come last in the file.
void put_in_order(std::vector<Camera>& read, const std::vector<Camera>& drawn) {
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        const auto found = std::find_if(read.begin(), read.end(), [&](const Camera& c) { return c.name == drawn[i].name; });
        if (found == read.end()) {
            throw Error("camera '" + drawn[i].name + "' was written but not read back");
        }
        std::swap(read[i], *found);
    }
}

}  // namespace

std::string write_random_scene(const RandomScene& random, const std::filesystem::path& path) {
    Scene in_file = random.scene;
    in_file.environment = {};
    write_gltf(in_file, path);
    if (random.scene.environment.kind == EnvironmentKind::map) {
        write_sky(random.scene.environment, sky_path(path));
    }
    const RenderSettings& s = random.settings;
    std::string out = fmt::format(
        "--size {}x{} --camera {} --integrator {} --brdf {} --normal-maps {} --sampler {} --mis {} --max-depth {}{}",
        s.width, s.height, random.scene.cameras[std::size_t(s.camera)].name, name_of(s.integrator), name_of(s.brdf), name_of(s.normal_maps), name_of(s.sampler),
        name_of(s.mis), s.max_depth, s.generic ? " --generic" : "");
    if (random.frames > 0) {
        out += fmt::format(" --frames {} --fps {}", random.frames, random_fps);
    }
    out += sky_arguments(random, path);
    const Camera& camera = random.scene.cameras[std::size_t(s.camera)];
    if (camera.lens.radius > 0) {
        out += fmt::format(" --aperture {} --focus {}", camera.lens.radius, camera.lens.focus_distance);
    }
    return out + (resamples(s.integrator) ? resampling_arguments(s.resampling) : "");
}

Scene read_random_scene(const RandomScene& random, const std::filesystem::path& path) {
    Scene scene = load_gltf(path);
    for (const std::string& line : scene.warnings.lines()) {
        if (line.find("lacks TEXCOORD_") == std::string::npos) {  // which is drawn on purpose
            throw Error(line);
        }
    }
    const Environment& sky = random.scene.environment;
    if (sky.kind == EnvironmentKind::map) {
        scene.environment = load_environment(sky_path(path).string());
    }
    scene.environment.kind = sky.kind;
    scene.environment.scale = sky.scale;
    scene.environment.rotation = sky.rotation;
    put_in_order(scene.cameras, random.scene.cameras);
    const auto camera = std::size_t(random.settings.camera);
    scene.cameras.at(camera).lens = random.scene.cameras[camera].lens;
    return scene;
}

}  // namespace diptych::core
