#include "scene/own_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/default_camera.h"
#include "scene/surface_points.h"

namespace diptych::core {
namespace {

constexpr int view_side = 24;       // pixels of a view
constexpr int emitter_count = 512;  // points
constexpr std::size_t most_cameras = 4;

// glTF's emissive factor goes to 1: a brighter material was given a strength, so it is meant as a light. Such lamps may
// light a tenth of the view with a hundredth of the sky's light, as at night. With less the picture is black.
constexpr double lamp_radiance = 1;
constexpr double least_from_lamps = 1e-2;
// Emission up to 1 may be a label, a display or a tail light. It has to light half of the view.
constexpr double least_brightness = 0.25;
constexpr double least_enclosure = 0.5;
constexpr double noise_of_textures = 1e-3;  // of images that JPEG keeps only nearly black

bool is_enough(const LightOfView& light) {
    return light.lamps >= least_from_lamps || light.brightness >= least_brightness ||
           light.enclosure >= least_enclosure;
}

/// The value that this share of them does not exceed; 0 of none.
double quantile(std::vector<double> values, double share) {
    if (values.empty()) {
        return 0;
    }
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

struct Emitters {
    std::vector<glm::dvec3> peaks;
    std::vector<SurfacePoint> points;

    explicit Emitters(const Scene& scene)
        : peaks(peak_emissions(scene)), points(emitting_points(scene, peaks, emitter_count)) {}

    bool is_lamp(const SurfacePoint& point) const {
        const glm::dvec3& peak = peaks[static_cast<std::size_t>(point.material)];
        return std::max({peak.x, peak.y, peak.z}) > lamp_radiance;
    }
};

/// The share of the hemisphere that the surface around `emitter` fills, by the cosine: that of a disc, which stays
/// below 1 however near it is.
double fills(const SurfacePoint& emitter, const SurfacePoint& point) {
    const glm::dvec3 way = emitter.position - point.position;
    const double square = glm::dot(way, way);
    const glm::dvec3 direction = way / std::sqrt(square);
    const double cosine = glm::dot(direction, point.normal);
    const double cosine_there = -glm::dot(direction, emitter.normal);
    const double facing = emitter.two_sided ? std::abs(cosine_there) : cosine_there;
    const bool sees = cosine > 0 && facing > 0;  // false for NaN
    return sees ? cosine * facing * emitter.area / (std::numbers::pi * square + emitter.area) : 0;
}

LightOfView light_of(const Scene& scene, const Emitters& emitters, const Camera& camera) {
    std::vector<double> lamps;
    std::vector<double> brightness;
    std::vector<double> enclosure;
    for (const SurfacePoint& point : seen_points(scene, emitters.peaks, camera, view_side)) {
        if (scene.materials[static_cast<std::size_t>(point.material)].unlit) {
            continue;  // shows its colour in any light
        }
        double from_lamps = 0;
        double from_all = 0;
        double filled = 0;
        for (const SurfacePoint& emitter : emitters.points) {
            const double share = fills(emitter, point);
            filled += emitter.emission > noise_of_textures ? share : 0;
            from_all += share * emitter.emission;
            from_lamps += emitters.is_lamp(emitter) ? share * emitter.emission : 0;
        }
        lamps.push_back(from_lamps);
        brightness.push_back(point.emission + from_all);
        enclosure.push_back(filled);
    }
    return {quantile(lamps, 0.9), quantile(brightness, 0.5), quantile(enclosure, 0.5), lamps.size()};
}

}  // namespace

LightOfView light_of_view(const Scene& scene, const Camera& camera) {
    return light_of(scene, Emitters(scene), camera);
}

OwnLight own_light(const Scene& scene) {
    if (!scene.lights.empty() || scene.environment.kind != Environment::Kind::none) {
        return OwnLight::enough;
    }
    const Emitters emitters(scene);
    if (emitters.points.empty()) {
        return OwnLight::absent;
    }
    std::size_t seen = 0;
    for (std::size_t i = 0; i < std::min(scene.cameras.size(), most_cameras); ++i) {
        const LightOfView light = light_of(scene, emitters, scene.cameras[i]);
        if (light.points > 0 && is_enough(light)) {
            return OwnLight::enough;
        }
        seen += light.points;
    }
    if (seen > 0) {
        return OwnLight::too_weak;
    }
    // Its cameras, if any, see nothing that reflects light.
    const LightOfView light = light_of(scene, emitters, frame_scene(scene));
    return light.points == 0 || is_enough(light) ? OwnLight::enough : OwnLight::too_weak;
}

}  // namespace diptych::core
