// Punctual lights on a diffuse floor, where the picture has no noise at all.
#include <numbers>

#include "render_fixture.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

constexpr double pi = std::numbers::pi;

Scene floor_under(const PunctualLight& light) {
    Scene scene;
    scene.name = "floor";
    const int floor = add_material(scene, diffuse_material(0.5F));
    add_object(scene, "floor", {horizontal_square(glm::vec3(0), 20, true, floor)});
    scene.cameras.push_back(point_camera({0.6, 0.4, 0.3}, {0, 0, 0}));
    scene.lights.push_back(light);
    return scene;
}

void check_radiance(const Scene& scene, const glm::dvec3& truth) {
    for (const Integrator integrator : integrators) {
        for (const SamplerKind sampler : {SamplerKind::independent, SamplerKind::sobol}) {
            RenderSettings settings = statistical_settings(4, 4, integrator, 3);
            settings.sampler = sampler;
            const ImageMean m = image_mean(render_cpu(scene, settings, 16));
            INFO(name_of(integrator) << ": " << describe(m) << "truth " << truth.x << " " << truth.y << " " << truth.z);
            for (int c = 0; c < 3; ++c) {
                CHECK(m.mean[static_cast<std::size_t>(c)] == Approx(truth[c]).epsilon(2e-4).margin(1e-9));
            }
        }
    }
}

/// A light at `position` that shines toward `target`.
glm::dmat4 aimed(const glm::dvec3& position, const glm::dvec3& target) {
    const glm::dvec3 z = glm::normalize(position - target);
    const glm::dvec3 x = glm::normalize(glm::cross(glm::dvec3(0.3, 0.1, 0.9), z));
    return glm::dmat4(glm::dvec4(x, 0), glm::dvec4(glm::cross(z, x), 0), glm::dvec4(z, 0), glm::dvec4(position, 1));
}

}  // namespace

TEST_CASE("A point light gives I cos / r^2, whatever its range and turn") {
    PunctualLight light;
    light.intensity = {3, 2, 1};
    light.light_to_world = aimed({1, 2, -1}, {5, 5, 5});
    const double r2 = 6;
    check_radiance(floor_under(light), glm::dvec3(3, 2, 1) * (0.5 / pi * 2 / std::sqrt(r2) / r2));
}

TEST_CASE("A directional light gives E cos, from any distance") {
    PunctualLight light;
    light.type = PunctualType::directional;
    light.intensity = {3, 2, 1};
    light.light_to_world = aimed({1, 2, -1}, {0, 0, 0});
    check_radiance(floor_under(light), glm::dvec3(3, 2, 1) * (0.5 / pi * 2 / std::sqrt(6.0)));
}

TEST_CASE("A spot light falls off between its cones as KHR_lights_punctual says") {
    PunctualLight light;
    light.type = PunctualType::spot;
    light.intensity = {3, 2, 1};
    light.inner_cone = 0.2;
    light.outer_cone = 0.6;
    const glm::dvec3 position(0, 2, 0);
    for (const double angle : {0.0, 0.1, 0.3, 0.45, 0.59, 0.61, 1.0}) {
        light.light_to_world = aimed(position, {2 * std::tan(angle), 0, 0});
        const double t = (std::cos(angle) - std::cos(0.6)) / (std::cos(0.2) - std::cos(0.6));
        const double falloff = std::pow(std::min(std::max(t, 0.0), 1.0), 2);
        INFO("angle " << angle);
        check_radiance(floor_under(light), glm::dvec3(3, 2, 1) * (0.5 / pi * falloff / 4));
    }
}

TEST_CASE("Punctual lights cast shadows, and none on what lies behind them") {
    PunctualLight light;
    light.light_to_world = aimed({0, 2, 0}, {0, 0, 0});
    for (const double height : {1.0, 3.0}) {
        Scene scene = floor_under(light);
        const int black = add_material(scene, diffuse_material(0));
        add_object(scene, "blocker", {horizontal_square({0, static_cast<float>(height), 0}, 0.2F, true, black)});
        const double truth = height < 2 ? 0.0 : 0.5 / pi / 4;
        check_radiance(scene, glm::dvec3(truth));
        scene.lights[0].type = PunctualType::directional;
        check_radiance(scene, glm::dvec3(0));
    }
}

TEST_CASE("Lights of all kinds add up") {
    PunctualLight point;
    point.light_to_world = aimed({0, 2, 0}, {0, 0, 0});
    PunctualLight sun;
    sun.type = PunctualType::directional;
    sun.intensity = glm::vec3(0.4F);
    Scene scene = floor_under(point);
    sun.light_to_world = aimed({0, 5, 0}, {0, 0, 0});
    scene.lights.push_back(sun);
    scene.environment.kind = Environment::Kind::constant;
    scene.environment.scale = glm::vec3(0.2F);
    const double truth = 0.5 * (0.25 / pi + 0.4 / pi + 0.2);
    for (const Integrator integrator : integrators) {
        const ImageMean m = image_mean(render_cpu(scene, statistical_settings(16, 16, integrator, 1), 3072));
        INFO(name_of(integrator) << ": " << describe(m) << "truth " << truth);
        CHECK(relative_error(m, exactly(truth)) < 2e-3);
        CHECK(worst_z(m, exactly(truth)) < 4.5);
    }
}
