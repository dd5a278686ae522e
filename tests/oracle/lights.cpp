// Light without surface, coverage, and what a picture of them must be to nearly all digits.
#include <cmath>

#include "catch.h"
#include "oracle_fixture.h"

namespace diptych::core::tests {

namespace {

using namespace oracle;

/// Depth 1 of one point of a grey Lambertian floor (y = 0, seen at the origin) under the scene's punctual lights.
Scene lit_floor(const PunctualLight& light, const glm::dmat4& matrix = glm::dmat4(1)) {
    Scene scene;
    Primitive floor = quad({-9, 0, 9}, {9, 0, 9}, {9, 0, -9}, {-9, 0, -9}, add_material(scene, lambertian(vec3(0.5F))));
    floor.normals.assign(floor.positions.size(), vec3(0, 1, 0));
    add_object(scene, "floor", {floor}, matrix);
    scene.lights.push_back(light);
    scene.cameras.push_back(narrow_camera({0.4, 3, 0.2}, {0, 0, 0}));
    return scene;
}

dvec3 depth_one(const Scene& scene) {
    return render(scene, small_settings(1, 1, 1), 16).depth(1).mean;
}

void check_close(const dvec3& a, const dvec3& b) {
    for (int k = 0; k < 3; ++k) {
        CHECK(a[k] == Approx(b[k]).epsilon(2e-6).margin(1e-12));
    }
}

}  // namespace

TEST_CASE("a spot light falls from its axis to its cone as glTF recommends", "[oracle]") {
    for (const double tilt : {0.0, 0.2, 0.35, 0.5, 0.62, 0.8}) {
        PunctualLight light;
        light.type = PunctualType::spot;
        light.intensity = {4, 5, 6};
        light.inner_cone = 0.3;
        light.outer_cone = 0.6;
        const dvec3 position(0.3, 1.2, -0.4);
        const dvec3 to_floor = normalize(-position);
        const dvec3 side = normalize(cross(to_floor, dvec3(1, 0, 0)));
        const dvec3 axis = std::cos(tilt) * to_floor + std::sin(tilt) * side;
        light.light_to_world[2] = glm::dvec4(-axis, 0);
        light.light_to_world[3] = glm::dvec4(position, 1);
        const double ramp = glm::clamp((std::cos(tilt) - std::cos(0.6)) / (std::cos(0.3) - std::cos(0.6)), 0.0, 1.0);
        const double cosine = -to_floor.y;
        INFO("tilt " << tilt);
        check_close(depth_one(lit_floor(light)),
                    dvec3(4, 5, 6) * (ramp * ramp * cosine / dot(position, position) * 0.5 / pi));
    }
}

TEST_CASE("a directional light gives its irradiance times the cosine", "[oracle]") {
    PunctualLight light;
    light.type = PunctualType::directional;
    light.intensity = {4, 5, 6};
    light.light_to_world[2] = glm::dvec4(normalize(dvec3(1, 2, 2)), 0);
    check_close(depth_one(lit_floor(light)), dvec3(4, 5, 6) * (2.0 / 3 * 0.5 / pi));
}

TEST_CASE("of many punctual lights each counts once", "[oracle]") {
    Scene scene = lit_floor(point_light({0.3, 1.2, -0.4}, {1, 1, 1}));
    double sum = 0;
    scene.lights.clear();
    for (int i = 0; i < 7; ++i) {
        const dvec3 position(0.3 * i, 1 + 0.1 * i, 0.2);
        scene.lights.push_back(point_light(position, vec3(float(i + 1))));
        sum += (i + 1) * position.y / std::pow(length(position), 3);
    }
    check_mean(render(scene, small_settings(4, 4, 1), 20000).depth(1), sum * 0.5 / pi);
}

TEST_CASE("normals of sheared and mirrored instances follow the surface", "[oracle]") {
    glm::dmat4 shear(1);
    shear[0] = {1, 0.5, 0, 0};     // tilts the floor
    shear[1] = {0.7, 2, -0.3, 0};  // and would tilt a normal that went along
    glm::dmat4 mirror(1);
    mirror[2][2] = -1.5;
    const dvec3 position(0.3, 1.2, -0.4);
    for (const glm::dmat4& matrix : {shear, mirror * shear}) {
        const dvec3 n = normalize(cross(dvec3(matrix[0]), dvec3(matrix[2])));
        const double cosine = std::abs(dot(normalize(position), n));
        check_close(depth_one(lit_floor(point_light(position, {4, 5, 6}), matrix)),
                    dvec3(4, 5, 6) * (cosine / dot(position, position) * 0.5 / pi));
    }
}

TEST_CASE("a scene far from the origin is lit as the one at the origin", "[oracle]") {
    const Scene near = lit_floor(point_light({0.3, 1.2, -0.4}, {4, 5, 6}));
    Scene far = near;
    const dvec3 offset(1e6, -3e5, 2e6);
    far.instances[0].object_to_world = translation(offset.x, offset.y, offset.z);
    far.lights[0].light_to_world[3] += glm::dvec4(offset, 0);
    far.cameras[0].camera_to_world[3] += glm::dvec4(offset, 0);
    check_close(depth_one(far), depth_one(near));
}

TEST_CASE("coverage lets its share of the sky, of a lamp and of a shadow through", "[oracle]") {
    // A covered sheet stands between the floor and a lamp, which is itself a covered sheet: each ray passes with 1 - a.
    for (const AlphaMode alpha : {AlphaMode::blend, AlphaMode::mask}) {
        Scene scene = lit_floor(point_light({0, 2, 0}, {4, 5, 6}));
        Material sheet = lambertian(vec3(0));
        sheet.alpha_mode = alpha;
        sheet.base_color.a = 0.25F;
        sheet.alpha_cutoff = 0.25F;
        const int black = add_material(scene, sheet);
        add_object(scene, "sheet", {quad({-1.5F, 1, 1}, {1, 1, 1}, {1, 1, -1}, {-1.5F, 1, -1}, black)});
        scene.cameras.back() = narrow_camera({3, 0.4, 2}, {0, 0, 0});
        const double passes = alpha == AlphaMode::blend ? 0.75 : 0;
        const Estimate e = render(scene, small_settings(4, 4, 1), 40000).depth(1);
        if (passes > 0) {
            check_mean(e, dvec3(4, 5, 6) * (passes / 4 * 0.5 / pi));
        } else {
            CHECK(e.mean == dvec3(0));
        }

        scene.lights.clear();
        scene.materials[std::size_t(black)].emission = {3, 2, 1};
        scene.materials[std::size_t(black)].double_sided = true;
        const double truth =
            polygon_irradiance({{-1.5, 1, 1}, {1, 1, 1}, {1, 1, -1}, {-1.5, 1, -1}}, dvec3(0), {0, 1, 0}) *
            (1 - passes) * 0.5 / pi;
        OracleSettings settings = small_settings(4, 4, 1);
        for (const Mode mode : all_modes()) {
            INFO(name_of(mode));
            settings.mode = mode;
            check_mean(render(scene, settings, 25000).depth(1), dvec3(3, 2, 1) * truth, 0.015);
        }
    }
}

TEST_CASE("an environment map lies and turns as described", "[oracle]") {
    Environment map;
    map.kind = EnvironmentKind::map;
    map.scale = {2, 1, 0.5F};
    map.width = 4;
    map.height = 2;
    // Columns begin behind and run over -x, -z and +x: by centres, u = 1/8, 3/8, 5/8, 7/8.
    map.texels = {{1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}, {10, 0, 0}, {20, 0, 0}, {30, 0, 0}, {40, 0, 0}};
    const auto red = [&](const dvec3& direction) { return environment_radiance(map, normalize(direction)).x / 2; };
    const double quarter = std::sqrt(0.5);
    const double up = 1;  // v = 1/4, the upper row's centre
    CHECK(red({-quarter, up, quarter}) == Approx(1));
    CHECK(red({-quarter, up, -quarter}) == Approx(2));
    CHECK(red({quarter, up, -quarter}) == Approx(3));
    CHECK(red({quarter, up, quarter}) == Approx(4));
    CHECK(red({0, up, -1}) == Approx(2.5));
    CHECK(red({0, up, 1}) == Approx(2.5));  // wraps between 4 and 1
    CHECK(red({-quarter, -up, -quarter}) == Approx(20));
    CHECK(red({-quarter, 0, -quarter}) == Approx(11));
    CHECK(red({-0.001, 1, -0.001}) == Approx(2));  // held beyond the last centre
    map.rotation = pi / 2;                         // seen from above, what stood at -z comes to -x
    CHECK(red({-quarter, up, quarter}) == Approx(2));
    CHECK(environment_radiance(map, normalize(dvec3(-quarter, up, quarter))).y == 0);
}

}  // namespace diptych::core::tests
