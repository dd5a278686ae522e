// Cameras and suns that a command line places.
#include "scene/viewpoint.h"

#include <cmath>

#include "catch.h"
#include "error.h"
#include "generate/generate.h"
#include "pose/pose.h"
#include "scene/sun.h"

using namespace diptych::core;

namespace {

using V = glm::dvec3;

using Point = std::optional<glm::dvec3>;

Viewpoint placed(const Point& eye, const Point& look_at, const Point& up = {}) {
    Viewpoint viewpoint;
    viewpoint.eye = eye;
    viewpoint.look_at = look_at;
    viewpoint.up = up;
    return viewpoint;
}

Viewpoint wide(double fov) {
    Viewpoint viewpoint;
    viewpoint.fov = fov;
    return viewpoint;
}

Viewpoint high(double view_height) {
    Viewpoint viewpoint;
    viewpoint.view_height = view_height;
    return viewpoint;
}

glm::dvec3 axis(const Camera& camera, int column) {
    return glm::dvec3(camera.camera_to_world[column]);
}

}  // namespace

TEST_CASE("a camera stands at the eye, looks at the point, and has up above") {
    Camera camera;
    camera.node = 2;
    place_at(placed(V(1, 2, 3), V(1, 2, -7)), camera);
    CHECK(axis(camera, 3) == V(1, 2, 3));
    CHECK(axis(camera, 2) == V(0, 0, 1));
    CHECK(axis(camera, 1) == V(0, 1, 0));
    CHECK(axis(camera, 0) == V(1, 0, 0));
    CHECK(camera.node == none);
    place_at(placed(V(0, 5, 0), V(0), V(0, 0, -2)), camera);
    place_at(wide(90), camera);
    CHECK(axis(camera, 2) == V(0, 1, 0));
    CHECK(axis(camera, 1) == V(0, 0, -1));
    CHECK(camera.vertical_fov == Approx(std::acos(-1.0) / 2));
}

TEST_CASE("an empty viewpoint leaves the camera, node included") {
    Camera camera;
    camera.node = 2;
    const glm::dmat4 before = camera.camera_to_world;
    place_at({}, camera);
    place_at(wide(20), camera);
    CHECK(camera.camera_to_world == before);
    CHECK(camera.node == 2);
}

TEST_CASE("viewpoints that are none are refused") {
    Camera camera;
    CHECK_THROWS_WITH(place_at(placed(V(1), V(1)), camera), Catch::Contains("one point"));
    CHECK_THROWS_WITH(place_at(placed(V(0, 1, 0), V(0)), camera), Catch::Contains("`up`: is parallel"));
    CHECK_THROWS_WITH(place_at(placed(V(0, 0, 1), V(0), V(0)), camera), Catch::Contains("no direction"));
    CHECK_THROWS_WITH(place_at(placed(V(0, 0, 1), {}), camera), Catch::Contains("`look_at`"));
    CHECK_THROWS_WITH(place_at(placed({}, V(0, 0, 1)), camera), Catch::Contains("`eye`"));
    CHECK_THROWS_WITH(place_at(placed({}, {}, V(0, 0, 1)), camera), Catch::Contains("`up`"));
    CHECK_THROWS_WITH(place_at(high(2), camera), Catch::Contains("not orthographic"));
    camera.orthographic = true;
    CHECK_THROWS_WITH(place_at(wide(20), camera), Catch::Contains("orthographic"));
}

TEST_CASE("the sun stands where its angles say, and shines away from there") {
    const auto from = [](double azimuth, double elevation) {
        const PunctualLight light = sun_light({azimuth, elevation, 3});
        const glm::dmat3 m(light.light_to_world);
        CHECK(glm::determinant(m) == Approx(1));
        CHECK(std::abs(glm::dot(m[0], m[1])) < 1e-12);
        CHECK(light.type == PunctualType::directional);
        CHECK(light.intensity == glm::vec3(3));
        return m[2];  // it shines along -Z
    };
    CHECK(glm::length(from(0, 0) - V(0, 0, -1)) < 1e-12);
    CHECK(glm::length(from(90, 0) - V(1, 0, 0)) < 1e-12);
    CHECK(glm::length(from(30, 90) - V(0, 1, 0)) < 1e-12);
    CHECK(from(200, -10).y < 0);
}

TEST_CASE("one camera at a moment is that of the scene posed then") {
    Scene scene = generate_scene("moving-light").scene;
    const Scene rest = scene;
    for (const double seconds : {0.0, 1.3, 4.0}) {
        pose_scene(scene, seconds);
        for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
            CHECK(camera_at(rest, i, seconds).camera_to_world == scene.cameras[i].camera_to_world);
        }
    }
}
