// Renders against closed forms (area lights). A bias of 1 % fails: standard errors are held at 0.2 % or less.
#include <cmath>
#include <numbers>

#include "lambert.h"
#include "render_fixture.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

constexpr double pi = std::numbers::pi;
constexpr float albedo = 0.5F;
const glm::dvec3 up(0, 1, 0);

/// A diffuse floor of which one point is seen, and nothing else.
Scene floor_scene(const glm::dvec3& eye) {
    Scene scene;
    scene.name = "floor";
    const int floor = add_material(scene, diffuse_material(albedo));
    add_object(scene, "floor", {horizontal_square(glm::vec3(0), 20, true, floor)});
    scene.cameras.push_back(point_camera(eye, {0, 0, 0}));
    return scene;
}

/// Light samples: `spp` a pixel, as many as the light's shape wants.
void check_irradiance(const Scene& scene, double irradiance, std::uint32_t spp_lights) {
    const double truth = albedo / pi * irradiance;
    for (const Integrator integrator : integrators) {
        const std::uint32_t spp = integrator == Integrator::brdf ? 6144 : spp_lights;
        const ImageMean m = image_mean(render_cpu(scene, statistical_settings(16, 16, integrator, 1), spp));
        INFO(name_of(integrator) << ": " << describe(m) << "truth " << truth);
        CHECK(m.nonfinite == 0);
        CHECK(relative_error(m, exactly(truth)) < 2e-3);
        CHECK(worst_z(m, exactly(truth)) < 4.5);
    }
}

Polygon square_above(double height, double half) {
    return {{-half, height, -half}, {half, height, -half}, {half, height, half}, {-half, height, half}};
}

}  // namespace

TEST_CASE("Lambert's formula gives the known value for the unit square at height 1") {
    CHECK(polygon_irradiance(square_above(1, 0.5), up) == Approx(0.752275).epsilon(1e-6));
    CHECK(polygon_irradiance(square_above(1, 1e4), up) == Approx(pi).epsilon(1e-3));
}

TEST_CASE("A square emitter lights a floor as Lambert's formula says") {
    Scene scene = floor_scene({0.6, 0.4, 0.3});
    const int light = add_material(scene, make_emitter("light", glm::vec3(1)));
    add_object(scene, "light", {horizontal_square({0, 1, 0}, 0.5F, false, light)});
    check_irradiance(scene, 0.752275, 512);
}

TEST_CASE("A parallel blocker takes away what its projection covers") {
    Scene scene = floor_scene({1.2, 0.2, 0.3});
    const int light = add_material(scene, make_emitter("light", glm::vec3(1)));
    const int black = add_material(scene, diffuse_material(0));
    add_object(scene, "light", {horizontal_square({0, 1, 0}, 1, false, light)});
    add_object(scene, "blocker", {horizontal_square({0, 0.5F, 0}, 0.25F, true, black)});
    check_irradiance(scene, polygon_irradiance(square_above(1, 1), up) - polygon_irradiance(square_above(1, 0.5), up),
                     1024);
}

TEST_CASE("An emitter that dips below the horizon counts only above it") {
    Scene scene = floor_scene({-0.8, 0.4, 0.3});
    // The floor ends short of the wall, so that nothing but the horizon hides the wall's lower half.
    scene.meshes[0].primitives[0] = horizontal_square(glm::vec3(0), 0.5F, true, 0);
    const int light = add_material(scene, make_emitter("light", glm::vec3(1)));
    Primitive wall;
    wall.material = light;
    add_quad(wall, {1, -1, 1}, {1, -1, -1}, {1, 1.5F, -1}, {1, 1.5F, 1});
    for (glm::uvec3& t : wall.triangles) {
        std::swap(t.y, t.z);
    }
    const Polygon polygon = {{1, -1, 1}, {1, -1, -1}, {1, 1.5, -1}, {1, 1.5, 1}};
    add_object(scene, "light", {wall});
    check_irradiance(scene, polygon_irradiance(polygon, up), 1400);
}

TEST_CASE("A facing sphere gives pi L r^2 / d^2") {
    Scene scene = floor_scene({0.9, 0.2, 0.3});
    const int light = add_material(scene, make_emitter("light", glm::vec3(1)));
    const Primitive sphere = make_sphere(0.5F, 48, 24, light);
    add_object(scene, "light", {sphere}, translation(0, 1, 0));
    const double exact = convex_irradiance(sphere, {0, 1, 0}, up);
    CHECK(exact == Approx(pi * 0.25).epsilon(0.01));
    check_irradiance(scene, exact, 6656);
}

TEST_CASE("One-sided emitters light nothing from behind, two-sided ones both sides alike") {
    for (const bool two_sided : {false, true}) {
        Scene scene = floor_scene({0.6, 0.4, 0.3});
        Material material = make_emitter("light", glm::vec3(1));
        material.double_sided = two_sided;
        const int light = add_material(scene, material);
        add_object(scene, "light", {horizontal_square({0, 1, 0}, 0.5F, true, light)});
        if (two_sided) {
            check_irradiance(scene, 0.752275, 512);
        }
        for (const Integrator integrator : integrators) {
            const ImageMean m = image_mean(render_cpu(scene, statistical_settings(4, 4, integrator, 4), 64));
            CHECK((m.mean[0] > 0) == two_sided);
        }
        // Seen directly, from the back and from the front.
        for (const double side : {-1.0, 1.0}) {
            scene.cameras = {point_camera({0.01, 1 + 0.5 * side, 0.01}, {0, 1, 0})};
            const ImageMean m = image_mean(render_cpu(scene, statistical_settings(4, 4, Integrator::path, 0), 16));
            CHECK(m.mean[0] == Approx(two_sided || side > 0 ? 1 : 0));
        }
    }
}

TEST_CASE("The closed furnace holds each bounce alone") {
    // Every surface emits Le and reflects rho: bounce k brings Le rho^k, however the light is found.
    constexpr double emitted = 0.25;
    Scene scene;
    scene.name = "room";
    Material glow = diffuse_material(albedo);
    glow.emission = glm::vec3(static_cast<float>(emitted));
    const int material = add_material(scene, glow);
    Primitive room;
    room.material = material;
    add_box(room, {-1, -1, -1}, {1, 1, 1});
    for (glm::uvec3& t : room.triangles) {
        std::swap(t.y, t.z);
    }
    add_object(scene, "room", {room});
    scene.cameras.push_back(make_camera("camera", {0.1, 0.2, 0.7}, {0, -0.1, -1}, 60));

    for (const Integrator integrator : integrators) {
        Film before;
        for (std::uint32_t depth = 0; depth <= 8; ++depth) {
            const Film film = render_cpu(scene, statistical_settings(32, 32, integrator, depth), 80);
            const ImageMean m = image_mean(film);
            const double sum = emitted * (1 - std::pow(albedo, depth + 1.0)) / (1 - albedo);
            INFO(name_of(integrator) << " depth " << depth << ": " << describe(m) << "truth " << sum);
            CHECK(m.nonfinite == 0);
            CHECK(relative_error(m, exactly(sum)) < 2e-3);
            CHECK(worst_z(m, exactly(sum)) < 4.5);
            if (depth > 0) {
                // The same random numbers: the difference of the films is the last bounce. Its error by the spread of
                // the pixels.
                double mean = 0;
                double squares = 0;
                const double n = static_cast<double>(film.pixels.size());
                for (std::size_t i = 0; i < film.pixels.size(); ++i) {
                    const double d = pixel_mean(film.pixels[i])[0] - pixel_mean(before.pixels[i])[0];
                    mean += d / n;
                    squares += d * d;
                }
                const double truth = emitted * std::pow(albedo, depth);
                const double error = std::sqrt(std::max(squares / n - mean * mean, 0.0) / (n - 1)) + 1e-6 * truth;
                INFO("bounce alone: " << mean << " truth " << truth << " error " << error);
                CHECK(std::abs(mean - truth) < 4.5 * error);
                CHECK(error < 0.08 * truth);  // a forgotten division by roulette's odds halves it and more
            }
            before = film;
        }
    }
}

TEST_CASE("A point light in the middle of a closed cube spreads evenly over its faces") {
    // By symmetry each face receives a sixth of each bounce's flux: its mean radiance after bounce k is I/6 rho^k (side
    // 2).
    Scene scene;
    scene.name = "cube";
    const int material = add_material(scene, diffuse_material(albedo));
    Primitive room;
    room.material = material;
    add_box(room, {-1, -1, -1}, {1, 1, 1});
    for (glm::uvec3& t : room.triangles) {
        std::swap(t.y, t.z);
    }
    add_object(scene, "room", {room});
    PunctualLight light;
    light.intensity = glm::vec3(6);
    scene.lights.push_back(light);
    Camera camera = make_camera("face", {0, 0, 0.5}, {0, 0, -1}, 60);
    camera.orthographic = true;
    camera.orthographic_height = 2;
    scene.cameras.push_back(camera);
    for (const Integrator integrator : integrators) {
        for (const std::uint32_t depth : {1U, 2U, 6U}) {
            const double truth = albedo * (1 - std::pow(albedo, depth)) / (1 - albedo);
            const ImageMean m = image_mean(render_cpu(scene, statistical_settings(32, 32, integrator, depth), 256));
            INFO(name_of(integrator) << " depth " << depth << ": " << describe(m) << "truth " << truth);
            CHECK(m.nonfinite == 0);
            CHECK(relative_error(m, exactly(truth)) < 2e-3);
            CHECK(worst_z(m, exactly(truth)) < 4.5);
        }
    }
}
