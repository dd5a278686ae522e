#include "view/invalidation.h"

#include <tuple>

namespace diptych::app {

namespace {

auto tie_resampling(const ResamplingSettings& r) {
    return std::tie(r.light_candidates, r.near_share, r.bsdf_candidate, r.temporal, r.spatial_passes, r.neighbors,
                    r.radius, r.confidence_cap, r.mis, r.visibility);
}

auto tie_settings(const RenderSettings& s) {
    return std::tie(s.width, s.height, s.integrator, s.brdf, s.normal_maps, s.sampler, s.mis, s.max_depth, s.sample_count, s.camera,
                    s.standard_error, s.first_hit_layers, s.generic, s.moves, s.atlas_tile);
}

/// What of a camera decides which code and which film is needed, and not only where its rays go.
auto features_of(const Camera& camera) {
    return std::tuple(camera.orthographic, camera.lens_radius > 0);
}

auto tie_pose(const Camera& c) {
    return std::tie(c.camera_to_world, c.vertical_fov, c.orthographic_height, c.lens_radius, c.focus_distance);
}

/// Lights that are there.
auto lights_of(const RenderRequest& request) {
    return std::tuple(request.sun.has_value(), request.environment_scale > 0);
}

auto tie_light(const RenderRequest& request) {
    return std::tie(request.sun, request.environment_scale, request.environment_rotation);
}

}  // namespace

bool same_settings(const RenderSettings& a, const RenderSettings& b) {
    return tie_settings(a) == tie_settings(b) && tie_resampling(a.resampling) == tie_resampling(b.resampling);
}

Invalidation invalidation(const RenderedState& before, const RenderedState& after) {
    if (before.scene != after.scene) {
        return Invalidation::scene;
    }
    if (!same_settings(before.request.settings, after.request.settings) ||
        features_of(before.camera) != features_of(after.camera) ||
        lights_of(before.request) != lights_of(after.request)) {
        return Invalidation::settings;
    }
    if (before.time != after.time || tie_light(before.request) != tie_light(after.request)) {
        return Invalidation::moment;
    }
    if (tie_pose(before.camera) != tie_pose(after.camera)) {
        return Invalidation::view;
    }
    return before.request.settings.seed != after.request.settings.seed ? Invalidation::picture : Invalidation::nothing;
}

}  // namespace diptych::app
