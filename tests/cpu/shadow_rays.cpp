// Shadow rays: they reach all the way to the light that was sampled, and no further.
#include <numbers>

#include "lambert.h"
#include "render_fixture.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

constexpr float albedo = 0.5F;

/// Two lamps over a floor at (-1, 1, 0) and (1, 1, 0), of half side 0.3, and a black plate.
Scene two_lamps(float plate_side, float plate_height) {
    Scene scene;
    scene.name = "two lamps";
    const int floor = add_material(scene, diffuse_material(albedo));
    const int light = add_material(scene, make_emitter("light", glm::vec3(1)));
    const int black = add_material(scene, diffuse_material(0));
    add_object(scene, "floor", {horizontal_square(glm::vec3(0), 20, true, floor)});
    add_object(scene, "left lamp", {horizontal_square({-1, 1, 0}, 0.3F, false, light)});
    add_object(scene, "right lamp", {horizontal_square({1, 1, 0}, 0.3F, false, light)});
    add_object(scene, "plate", {horizontal_square({plate_side, plate_height, 0}, 0.32F, false, black)});
    scene.cameras.push_back(point_camera({0.05, 0.3, 0.4}, {0, 0, 0}));
    return scene;
}

void check_one_lamp(const Scene& scene) {
    const Polygon lamp = {{0.7, 1, -0.3}, {1.3, 1, -0.3}, {1.3, 1, 0.3}, {0.7, 1, 0.3}};
    const double truth = static_cast<double>(albedo) / std::numbers::pi * polygon_irradiance(lamp, {0, 1, 0});
    for (const Integrator integrator : integrators) {
        const std::uint32_t spp = integrator == Integrator::brdf ? 16384 : 2048;
        const ImageMean m = image_mean(render_cpu(scene, statistical_settings(16, 16, integrator, 1), spp));
        INFO(name_of(integrator) << ": " << describe(m) << "truth " << truth);
        CHECK(m.nonfinite == 0);
        CHECK(relative_error(m, exactly(truth)) < 4e-3);
        CHECK(worst_z(m, exactly(truth)) < 4.5);
    }
}

}  // namespace

TEST_CASE("A plate hides the lamp behind it and no other, on either side") {
    check_one_lamp(two_lamps(-0.75F, 0.75F));
    check_one_lamp(two_lamps(0.75F, 0.75F));
}

TEST_CASE("An occluder in the last hundredth of the way hides its lamp all the same") {
    check_one_lamp(two_lamps(1, 0.996F));
}

TEST_CASE("Lights from 1 mm to 100 km away are hidden by what lies before them, and by nothing behind") {
    for (const double distance : {1e-3, 1.0, 1e5}) {
        for (const double plate : {0.5, 0.992, 1.01}) {
            Scene scene;
            scene.name = "near and far";
            const int floor = add_material(scene, diffuse_material(albedo));
            const int black = add_material(scene, diffuse_material(0));
            const auto size = static_cast<float>(distance);
            add_object(scene, "floor", {horizontal_square(glm::vec3(0), size, true, floor)});
            add_object(scene, "plate",
                       {horizontal_square({0, static_cast<float>(distance * plate), 0}, 0.2F * size, false, black)});
            PunctualLight light;
            light.intensity = glm::vec3(static_cast<float>(distance * distance));
            light.light_to_world = translation(0, distance, 0);
            scene.lights.push_back(light);
            scene.cameras.push_back(point_camera(distance * glm::dvec3(0.6, 0.3, 0.3), {0, 0, 0}));
            const double truth = plate < 1 ? 0 : static_cast<double>(albedo) / std::numbers::pi;
            for (const Integrator integrator : integrators) {
                const ImageMean m = image_mean(render_cpu(scene, statistical_settings(4, 4, integrator, 1), 16));
                INFO("light at " << distance << " m, plate at " << plate << " of it, " << name_of(integrator));
                CHECK(m.nonfinite == 0);
                CHECK(m.mean[0] == Approx(truth).epsilon(1e-3).margin(1e-9));
            }
        }
    }
}
