#include "render/moment.h"

#include <numbers>
#include <tuple>

#include "error.h"
#include "pose/pose.h"
#include "scene/orbit.h"

namespace diptych::core {

namespace {

auto tie_resampling(const ResamplingSettings& r) {
    return std::tie(r.light_candidates, r.near_share, r.bsdf_candidate, r.temporal, r.spatial_passes, r.neighbors,
                    r.radius, r.confidence_cap, r.mis, r.visibility);
}

auto tie_settings(const RenderSettings& s) {
    return std::tie(s.width, s.height, s.integrator, s.brdf, s.normal_maps, s.sampler, s.mis,
                    s.light_sampler, s.max_depth, s.sample_count, s.camera, s.standard_error, s.first_hit_layers, s.generic, s.moves, s.atlas_tile);
}

/// What of a camera decides which code and which film is needed. It stays for a camera that is the scene's own.
auto features_of(const Moment& moment) {
    const bool own = !moment.camera;
    return std::tuple(own, !own && moment.camera->orthographic, !own && moment.camera->lens.radius > 0);
}

auto pose_of(const Moment& moment) {
    const Camera camera = moment.camera.value_or(Camera());
    const Orbit orbit = moment.orbit.value_or(Orbit());
    return std::tuple(camera.camera_to_world, camera.vertical_fov, camera.orthographic_height, camera.lens, orbit.pivot,
                      orbit.degrees);
}

/// Lights that are there.
auto lights_of(const Moment& moment) {
    return std::tuple(moment.sun.has_value(), moment.environment_scale > 0);
}

auto tie_light(const Moment& moment) {
    return std::tie(moment.sun, moment.environment_scale, moment.environment_rotation);
}

}  // namespace

bool changes_environment(const Moment& moment) {
    return moment.environment_scale != 1 || moment.environment_rotation != 0;
}

void put_lights(const Scene& loaded, const Moment& moment, Scene& scene) {
    if (loaded.environment.kind == Environment::Kind::none && changes_environment(moment)) {
        throw Error(loaded.name + ": has no environment that could be scaled or turned");
    }
    const glm::vec3 scale = loaded.environment.scale * static_cast<float>(moment.environment_scale);
    const double rotation = loaded.environment.rotation + moment.environment_rotation * std::numbers::pi / 180;
    const std::size_t lights = loaded.lights.size();
    scene.environment.scale = scale;
    scene.environment.rotation = rotation;
    scene.lights.resize(lights);
    if (moment.sun) {
        scene.lights.push_back(sun_light(*moment.sun));
    }
}

void put_moment(const Scene& loaded, const Moment& moment, int camera, Scene& scene) {
    const auto index = static_cast<std::size_t>(camera);
    if (index < scene.cameras.size() && &scene != &loaded) {
        scene.cameras[index] = loaded.cameras[index];  // an orbit may have turned it
    }
    if (moment.seconds && moves(loaded)) {
        pose_scene(scene, *moment.seconds);
    }
    put_lights(loaded, moment, scene);
    if (moment.camera) {
        scene.cameras.at(index) = *moment.camera;
    }
    if (moment.orbit) {
        orbit_camera(scene.cameras.at(index), moment.orbit->pivot, moment.orbit->degrees);
    }
}

bool same_settings(const RenderSettings& a, const RenderSettings& b) {
    return tie_settings(a) == tie_settings(b) && tie_resampling(a.resampling) == tie_resampling(b.resampling);
}

Change change_between(const Moment& before, const RenderSettings& settings_before, const Moment& after,
                      const RenderSettings& settings_after) {
    if (!same_settings(settings_before, settings_after) || features_of(before) != features_of(after) ||
        lights_of(before) != lights_of(after)) {
        return Change::settings;
    }
    if (before.seconds != after.seconds || tie_light(before) != tie_light(after)) {
        return Change::moment;
    }
    if (pose_of(before) != pose_of(after)) {
        return Change::view;
    }
    return settings_before.seed != settings_after.seed ? Change::picture : Change::nothing;
}

}  // namespace diptych::core
