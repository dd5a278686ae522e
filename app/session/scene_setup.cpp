#include "session/scene_setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>
#include <sstream>

#include "error.h"
#include "near_miss.h"
#include "console/report.h"
#include "pose/clips.h"
#include "scene/completion.h"
#include "scene/environment_load.h"
#include "gltf/import.h"
#include "render/frames.h"

namespace diptych::core::app {

namespace {

/// "R,G,B" as a colour; nothing where the text is not three numbers.
std::optional<glm::vec3> parse_color(const std::string& text) {
    glm::vec3 color{0};
    const char* at = text.data();
    const char* end = at + text.size();
    for (int channel = 0; channel < 3; ++channel) {
        const auto [stop, failure] = std::from_chars(at, end, color[channel]);
        const bool last = channel == 2;
        if (failure != std::errc() || (last ? stop != end : stop == end || *stop != ',')) {
            return std::nullopt;
        }
        at = stop + 1;
    }
    return color;
}

Environment requested_environment(const std::string& text, std::uint64_t memory_limit, Warnings& warnings) {
    const std::optional<glm::vec3> color = parse_color(text);
    if (!color) {
        const bool like_numbers = text.find_first_not_of("0123456789+-.,eE ") == std::string::npos;
        if (like_numbers && !std::filesystem::exists(text)) {
            throw Error(fmt::format("--env {}: expected three numbers R,G,B or a file", text));
        }
        std::string lines;
        const Environment environment = load_environment(text, &lines, memory_limit);
        std::istringstream stream(lines);
        for (std::string line; std::getline(stream, line);) {
            warnings.add(line);
        }
        return environment;
    }
    for (int channel = 0; channel < 3; ++channel) {
        if (!std::isfinite((*color)[channel]) || (*color)[channel] < 0) {
            throw Error(fmt::format("--env {}: radiance must be finite and not negative", text));
        }
    }
    Environment environment;
    environment.kind = Environment::Kind::constant;
    environment.scale = *color;
    return environment;
}

/// The request's environment. Without one, a neutral sky where the scene would come out black: the one place that
/// decides so, for every command.
void find_environment(Scene& scene, RenderRequest& request) {
    request.adds_neutral_sky = false;
    if (request.environment == no_environment) {
        scene.environment = {};
    } else if (request.environment == neutral_environment) {
        scene.environment = neutral_sky();
    } else if (!request.environment.empty()) {
        scene.environment = requested_environment(request.environment, request.memory_limit, scene.warnings);
    } else if (!request.sun) {
        request.adds_neutral_sky = add_missing_light(scene, " (--env none leaves it out)");
    }
}

std::string camera_list(const Scene& scene) {
    std::string list;
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
        list += fmt::format("{}{} '{}'", list.empty() ? "" : ", ", i, scene.cameras[i].name);
    }
    return list;
}

/// The camera of that very name, else of that index.
int find_camera(const Scene& scene, const std::string& wanted) {
    const auto named = std::find_if(scene.cameras.begin(), scene.cameras.end(),
                                    [&](const Camera& camera) { return camera.name == wanted; });
    if (named != scene.cameras.end()) {
        return static_cast<int>(named - scene.cameras.begin());
    }
    std::size_t index = 0;
    const char* end = wanted.data() + wanted.size();
    const auto [stop, failure] = std::from_chars(wanted.data(), end, index);
    if (failure != std::errc() || stop != end || index >= scene.cameras.size()) {
        std::vector<std::string> names;
        for (const Camera& camera : scene.cameras) {
            names.push_back(camera.name);
        }
        throw Error(fmt::format("{}: no camera '{}'{}; there are {}", scene.name, wanted, did_you_mean(wanted, names),
                                names.empty() ? "none" : camera_list(scene)));
    }
    return static_cast<int>(index);
}

void choose_camera(Scene& scene, RenderRequest& request) {
    const bool fits = request.camera.empty() || request.camera == "0";
    if (fits && add_missing_camera(scene) && !request.viewpoint.eye) {
        scene.warnings.add("the scene has no camera; a default camera that frames it is used", scene.name);
    }
    if (!request.camera.empty()) {
        request.settings.camera = find_camera(scene, request.camera);
    }
}

void choose_clips(Scene& scene, const RenderRequest& request) {
    if (request.clip.empty()) {
        play_all_clips(scene);
    } else {
        play_clip(scene, find_clip(scene, request.clip));
    }
}

}  // namespace

Scene load_requested(RenderRequest& request) {
    Scene scene = load_gltf(
        request.scene, {request.ignored_extensions, request.strict, request.allow_external, request.memory_limit});
    if (scene.name.empty()) {
        scene.name = request.scene;
    }
    choose_clips(scene, request);
    find_environment(scene, request);
    choose_camera(scene, request);
    return scene;
}

namespace {

void place_lights(const RenderRequest& request, Scene& scene) {
    const Moment moment = requested_lights(request);
    if (scene.environment.kind == Environment::Kind::none && changes_environment(moment)) {
        throw Error(fmt::format(
            "{}: --env-scale and --env-rotate need an environment, and the scene has none; give --env", scene.name));
    }
    put_lights(scene, moment, scene);
}

void place_camera(const RenderRequest& request, Scene& scene) {
    Camera& camera = scene.cameras[static_cast<std::size_t>(request.settings.camera)];
    if (request.lens.radius.value_or(0) > 0 && !request.lens.focus_distance) {
        throw Error("--aperture: needs --focus, the focus distance");
    }
    place_at(request.viewpoint, camera);
    place_lens(request.lens, camera);
}

}  // namespace

Scene place_requested(RenderRequest& request) {
    Scene scene = load_requested(request);
    place_lights(request, scene);
    place_camera(request, scene);
    return scene;
}

void report_clips(const Scene& scene, const RenderRequest& request) {
    const Warnings warnings = clip_warnings(scene);
    if (request.strict && !warnings.empty()) {
        throw Error(warnings.lines().front());
    }
    report_warnings(warnings);
}

}  // namespace diptych::core::app
