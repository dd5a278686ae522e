// Closed rooms whose light is known after each bounce.
#include <cmath>

#include "catch.h"
#include "oracle_fixture.h"

namespace diptych::core::tests {

namespace {

/// A sphere of flat triangles around the origin, so fine that its shape costs less than `sphere_error`.
Primitive fine_sphere(int material) {
    Primitive sphere = make_sphere(2, 256, 128, material);
    sphere.normals.clear();
    return sphere;
}
constexpr double sphere_error = 6e-4;

}  // namespace

TEST_CASE("a closed diffuse furnace holds Le rho^k after k bounces", "[oracle]") {
    Scene scene;
    Material wall = lambertian({0.5F, 0.7F, 0.9F});
    wall.emission = {1, 2, 3};
    wall.double_sided = true;
    Primitive box;
    box.material = add_material(scene, wall);
    add_box(box, vec3(-1, -1, -1), vec3(1, 2, 3));
    add_object(scene, "room", {box});
    scene.cameras.push_back(make_camera("inside", {0.2, 0.3, 0.4}, {-1, 0, 1}, 90));
    // Not by area: in a room's edges points come close, and their variance has no bound.
    for (const oracle::Mode mode : {oracle::Mode::mis, oracle::Mode::bsdf, oracle::Mode::hemisphere}) {
        INFO(name_of(mode));
        OracleSettings settings = small_settings(8, 8, 5);
        settings.mode = mode;
        const Rendered picture = render(scene, settings,
                                        mode == oracle::Mode::hemisphere ? 2500
                                        : mode == oracle::Mode::mis      ? 800
                                                                         : 32);
        for (unsigned k = 0; k <= 5; ++k) {
            INFO("depth " << k);
            const dvec3 truth = dvec3(1, 2, 3) * pow(dvec3(vec3(0.5F, 0.7F, 0.9F)), dvec3(k));
            check_mean(picture.depth(k), truth, 0.02);
        }
        check_mean(picture.depth(1), dvec3(vec3(0.5F, 1.4F, 2.7F)), 0.003);
    }
}

TEST_CASE("roulette leaves a long furnace's sum alone", "[oracle]") {
    Scene scene;
    Material wall = lambertian(vec3(0.9F));
    wall.emission = vec3(1);
    wall.double_sided = true;
    Primitive box;
    box.material = add_material(scene, wall);
    add_box(box, vec3(-1), vec3(1));
    add_object(scene, "room", {box});
    scene.cameras.push_back(make_camera("inside", {0, 0, 0}, {0, 0, 1}, 60));
    OracleSettings settings = small_settings(8, 8, 60);
    settings.mode = oracle::Mode::bsdf;  // which has no variance here but the roulette's
    const Rendered picture = render(scene, settings, 400);
    const double rho = double(0.9F);
    check_mean(picture.all(), (1 - std::pow(rho, 61)) / (1 - rho), 0.01);
    check_mean(picture.depth(16), std::pow(rho, 16));
    check_mean(picture.depth(30), std::pow(rho, 30), 0.1);
}

TEST_CASE("a point light at a sphere's centre gives rho^k I / (pi r^2) after k bounces", "[oracle]") {
    Scene scene;
    add_object(scene, "room", {fine_sphere(add_material(scene, lambertian(vec3(0.6F))))});
    scene.lights.push_back(point_light({0, 0, 0}, {5, 10, 20}));
    scene.cameras.push_back(make_camera("inside", {0.5, 0.1, 0.2}, {1, 2, 3}, 70));
    for (const oracle::Mode mode : {oracle::Mode::mis, oracle::Mode::bsdf, oracle::Mode::hemisphere}) {
        INFO(name_of(mode));
        OracleSettings settings = small_settings(8, 8, 4);
        settings.mode = mode;
        const Rendered picture = render(scene, settings, mode == oracle::Mode::hemisphere ? 1500 : 32);
        CHECK(picture.depth(0).mean == dvec3(0));
        for (unsigned k = 1; k <= 4; ++k) {
            INFO("depth " << k);
            const dvec3 truth = dvec3(5, 10, 20) * (std::pow(double(0.6F), k) / (4 * oracle::pi));
            check_mean(picture.depth(k), truth, k <= 1 ? 0.003 : 0.01, sphere_error);
        }
    }
}

TEST_CASE("an integrating sphere of two halves mixes by area at each bounce", "[oracle]") {
    Scene scene;
    Material upper = lambertian({0.3F, 0.5F, 0.8F});
    upper.emission = {1, 0.5F, 0.25F};
    upper.double_sided = true;
    Material lower = lambertian({0.8F, 0.4F, 0.1F});
    lower.emission = {0.2F, 2, 0.1F};
    lower.double_sided = true;
    const int materials[] = {add_material(scene, upper), add_material(scene, lower)};
    const Primitive sphere = fine_sphere(0);
    Primitive halves[] = {sphere, sphere};
    for (int half = 0; half < 2; ++half) {
        halves[half].material = materials[half];
        std::erase_if(halves[half].triangles, [&](const glm::uvec3& t) {
            const float y = sphere.positions[t.x].y + sphere.positions[t.y].y + sphere.positions[t.z].y;
            return (y > 0) != (half == 0);
        });
        REQUIRE(halves[half].triangles.size() == sphere.triangles.size() / 2);
    }
    add_object(scene, "room", {halves[0], halves[1]});
    scene.cameras.push_back(make_camera("inside", {0.5, 0.1, 0.2}, {0.5, 2, 0.3}, 20));
    const dvec3 rho[] = {dvec3(upper.base_color), dvec3(lower.base_color)};
    const dvec3 mean_le = 0.5 * (dvec3(upper.emission) + dvec3(lower.emission));
    const dvec3 mean_rho = 0.5 * (rho[0] + rho[1]);
    for (const oracle::Mode mode : all_modes()) {
        INFO(name_of(mode));
        OracleSettings settings = small_settings(8, 8, 3);
        settings.mode = mode;
        const Rendered picture = render(scene, settings, mode == oracle::Mode::area ? 6000 : 1200);
        check_mean(picture.depth(0), dvec3(upper.emission));
        dvec3 truth = rho[0] * mean_le;
        for (unsigned k = 1; k <= 3; ++k) {
            INFO("depth " << k);
            check_mean(picture.depth(k), truth, k == 1 && mode == oracle::Mode::area ? 0.003 : 0.02, sphere_error);
            truth *= mean_rho;
        }
    }
}

}  // namespace diptych::core::tests
