// Direct light whose irradiance is known: polygons, blockers, spheres, and the same through odd transforms.
#include <cmath>

#include "catch.h"
#include "oracle_fixture.h"

namespace diptych::core::tests {

namespace {

const vec3 white(0.5F);

/// A grey floor at y = 0 that the camera sees at the origin, and nothing else.
Scene floor_scene() {
    Scene scene;
    add_object(scene, "floor",
               {quad({-9, 0, 9}, {9, 0, 9}, {9, 0, -9}, {-9, 0, -9}, add_material(scene, lambertian(white)))});
    scene.cameras.push_back(narrow_camera({3, 0.4, 2}, {0, 0, 0}));
    return scene;
}

/// A square of side `side` at height y around the axis, its front downward.
Primitive ceiling_square(float side, float y, int material) {
    const float h = side / 2;
    return quad({-h, y, -h}, {h, y, -h}, {h, y, h}, {-h, y, h}, material);
}

std::vector<dvec3> square_points(double side, double y) {
    const double h = side / 2;
    return {{-h, y, -h}, {h, y, -h}, {h, y, h}, {-h, y, h}};
}

/// Depth 1 at the floor's origin is rho / pi E in each mode; those that find lights by chance have less power.
void check_irradiance(const Scene& scene, const dvec3& irradiance, double half_width_by_chance = 0.009,
                      std::uint64_t spp = 25000, double half_width_by_area = 0.003) {
    for (const oracle::Mode mode : all_modes()) {
        const double half_width =
            mode == oracle::Mode::area || mode == oracle::Mode::mis ? half_width_by_area : half_width_by_chance;
        INFO(name_of(mode));
        OracleSettings settings = small_settings(4, 4, 1);
        settings.mode = mode;
        check_mean(render(scene, settings, spp).depth(1), irradiance * (0.5 / oracle::pi), half_width, 2e-6);
    }
}

}  // namespace

TEST_CASE("a square light gives Lambert's irradiance, and none through its back", "[oracle]") {
    CHECK(polygon_irradiance(square_points(1, 1), dvec3(0), {0, 1, 0}) == Approx(0.752275).epsilon(1e-6));
    Scene scene = floor_scene();
    const int light = add_material(scene, make_emitter("light", {3, 2, 1}));
    add_object(scene, "light", {ceiling_square(1, 1, light)});
    const dvec3 truth = dvec3(3, 2, 1) * 0.752275;
    check_irradiance(scene, truth);

    std::swap(scene.meshes.back().primitives[0].triangles[0].y, scene.meshes.back().primitives[0].triangles[0].z);
    std::swap(scene.meshes.back().primitives[0].triangles[1].y, scene.meshes.back().primitives[0].triangles[1].z);
    for (const oracle::Mode mode : all_modes()) {
        OracleSettings settings = small_settings(2, 2, 1);
        settings.mode = mode;
        CHECK(render(scene, settings, 100).depth(1).mean == dvec3(0));
    }
    scene.materials[std::size_t(light)].double_sided = true;
    check_irradiance(scene, truth);
}

TEST_CASE("a parallel blocker takes away its projection's irradiance", "[oracle]") {
    Scene scene = floor_scene();
    const int light = add_material(scene, make_emitter("light", {3, 2, 1}));
    add_object(scene, "light", {ceiling_square(1, 1, light)});
    add_object(scene, "blocker", {ceiling_square(0.25F, 0.5F, add_material(scene, lambertian(vec3(0))))});
    const double truth = polygon_irradiance(square_points(1, 1), dvec3(0), {0, 1, 0}) -
                         polygon_irradiance(square_points(0.5, 1), dvec3(0), {0, 1, 0});
    check_irradiance(scene, dvec3(3, 2, 1) * truth, 0.012);
}

TEST_CASE("a sphere light that faces the surface gives pi L r^2 / d^2", "[oracle]") {
    Scene scene = floor_scene();
    Primitive sphere = make_sphere(0.5F, 256, 128, add_material(scene, make_emitter("light", {3, 2, 1})));
    double area = 0;
    for (const glm::uvec3& t : sphere.triangles) {
        const dvec3 a(sphere.positions[t.x]);
        area += 0.5 * length(cross(dvec3(sphere.positions[t.y]) - a, dvec3(sphere.positions[t.z]) - a));
    }
    add_object(scene, "light", {sphere}, translation(0, 2, 0));
    // A convex body's mean projection is a quarter of its surface (Cauchy).
    const double truth = area / 4 / 4;
    CHECK(truth == Approx(oracle::pi * 0.25 / 4).epsilon(1e-3));
    check_irradiance(scene, dvec3(3, 2, 1) * truth, 0.02, 40000, 0.0045);
}

TEST_CASE("mirrored and sheared instances carry light, front and area with them", "[oracle]") {
    glm::dmat4 shear(1);
    shear[1] = {0.4, 1, 0.3, 0};
    shear[2] = {0.2, -0.1, 1.5, 0};
    glm::dmat4 mirror(1);
    mirror[0][0] = -0.7;
    for (const glm::dmat4& matrix : {shear, mirror * shear, translation(0.3, 0.2, -0.4) * mirror}) {
        Scene scene = floor_scene();
        const int light = add_material(scene, make_emitter("light", {3, 2, 1}));
        add_object(scene, "light", {ceiling_square(1, 1, light)}, matrix);
        std::vector<dvec3> corners;
        for (const dvec3& p : square_points(1, 1)) {
            corners.emplace_back(matrix * glm::dvec4(p, 1));
        }
        const double truth = polygon_irradiance(corners, dvec3(0), {0, 1, 0});
        check_irradiance(scene, dvec3(3, 2, 1) * truth, 0.012, 30000);
    }
}

TEST_CASE("a textured emitter gives what its texels add up to", "[oracle]") {
    Scene scene = floor_scene();
    // Two texels, decoded 0.2158605 and 1, blended across the middle half and held beyond.
    scene.images.push_back({"two", 2, 1, {128, 0, 255, 255, 255, 128, 0, 255}});
    scene.textures.push_back({"two", 0, Wrap::clamp, Wrap::clamp, Filter::linear});
    Material material = make_emitter("light", {3, 2, 1});
    material.emission_texture.texture = 0;
    Primitive light = ceiling_square(1, 1, add_material(scene, material));
    light.uvs[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    add_object(scene, "light", {light});
    dvec3 truth(0);
    const int n = 400;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const double x = (i + 0.5) / n - 0.5;
            const double z = (j + 0.5) / n - 0.5;
            const double blend = glm::clamp((x + 0.5) * 2 - 0.5, 0.0, 1.0);
            const double grey = 0.21586050011389926;
            const dvec3 texel = dvec3(grey, 0, 1) * (1 - blend) + dvec3(1, grey, 0) * blend;
            const double d2 = x * x + z * z + 1;
            truth += texel / (d2 * d2 * n * n);
        }
    }
    check_irradiance(scene, dvec3(3, 2, 1) * truth, 0.012, 40000);
}

}  // namespace diptych::core::tests
