// What a hand does to a camera.
#include "view/camera_control.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "catch.h"
#include "generate/shapes.h"
#include "scene/viewpoint.h"

using namespace diptych::core;
using namespace diptych::core::app;

namespace {

constexpr double pi = glm::pi<double>();

Camera some_camera(bool orthographic) {
    Camera camera = make_camera("camera", {3, 2, 5}, {0.5, 1, -1}, 40);
    camera.orthographic = orthographic;
    camera.orthographic_height = 2.5;
    camera.lens.focus_distance = 4;
    return camera;
}

double difference(const Camera& a, const Camera& b) {
    double worst = 0;
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            worst = std::max(worst, std::abs(a.camera_to_world[column][row] - b.camera_to_world[column][row]));
        }
    }
    return worst;
}

/// Whether the columns are unit and at right angles.
double shear(const Camera& camera) {
    const glm::dmat3 m(camera.camera_to_world);
    const glm::dmat3 off = glm::transpose(m) * m - glm::dmat3(1);
    double worst = 0;
    for (int column = 0; column < 3; ++column) {
        worst = std::max(worst, glm::length(off[column]));
    }
    return worst;
}

/// Where a point is seen, in [0, 1]^2, y down.
glm::dvec2 seen_at(const Camera& camera, const glm::dvec3& point, double aspect) {
    const glm::dvec3 local(glm::inverse(camera.camera_to_world) * glm::dvec4(point, 1));
    const double height =
        camera.orthographic ? camera.orthographic_height / 2 : -local.z * std::tan(camera.vertical_fov / 2);
    return {0.5 + 0.5 * local.x / (height * aspect), 0.5 - 0.5 * local.y / height};
}

}  // namespace

TEST_CASE("An orbit by 360 degrees is the identity", "[view]") {
    for (const bool orthographic : {false, true}) {
        const Camera before = some_camera(orthographic);
        Camera camera = before;
        for (int i = 0; i < 360; ++i) {
            orbit(camera, {0.2, 0.3, -0.4}, pi / 180, 0);
        }
        CHECK(difference(camera, before) < 1e-9);
        for (int i = 0; i < 100; ++i) {
            orbit(camera, {0.2, 0.3, -0.4}, 0, 0.002);
        }
        for (int i = 0; i < 100; ++i) {
            orbit(camera, {0.2, 0.3, -0.4}, 0, -0.002);
        }
        CHECK(difference(camera, before) < 1e-9);
        CHECK(shear(camera) < 1e-12);
    }
}

TEST_CASE("An orbit keeps the distance to its pivot and where that is seen", "[view]") {
    const glm::dvec3 pivot(0.5, 1, -1);
    Camera camera = some_camera(false);
    const double distance = glm::length(glm::dvec3(camera.camera_to_world[3]) - pivot);
    orbit(camera, pivot, 0.7, 0.4);
    CHECK(glm::length(glm::dvec3(camera.camera_to_world[3]) - pivot) == Approx(distance).epsilon(1e-12));
    const glm::dvec2 seen = seen_at(camera, pivot, 1.5);
    CHECK(std::abs(seen.x - 0.5) < 1e-9);
    CHECK(std::abs(seen.y - 0.5) < 1e-9);
    CHECK(camera.camera_to_world[3].y > some_camera(false).camera_to_world[3].y);  // a positive pitch raises it
}

TEST_CASE("Poles do not flip the camera", "[view]") {
    for (const double pitch : {0.3, -0.3, 20.0, -20.0}) {
        Camera camera = some_camera(false);
        for (int i = 0; i < 40; ++i) {
            orbit(camera, {0.5, 1, -1}, 0.01, pitch);
            CHECK(camera.camera_to_world[1].y > 0);  // up stays up
        }
        CHECK(std::abs(camera.camera_to_world[2].y) < 1);
        CHECK(std::abs(camera.camera_to_world[2].y) > std::sin(89.0 * pi / 180));
        orbit(camera, {0.5, 1, -1}, 0, pitch > 0 ? -1 : 1);
        CHECK(std::abs(camera.camera_to_world[2].y) < std::sin(80.0 * pi / 180));  // and there is a way back
        CHECK(std::abs(camera.camera_to_world[0].y) < 1e-9);                       // without a roll
    }
}

TEST_CASE("A camera that looks straight down can be turned", "[view]") {
    Camera camera = some_camera(false);
    Viewpoint above;
    above.eye = glm::dvec3(0, 5, 0);
    above.look_at = glm::dvec3(0);
    above.up = glm::dvec3(0, 0, -1);
    place_at(above, camera);
    orbit(camera, glm::dvec3(0), 0.5, -0.5);
    CHECK(shear(camera) < 1e-12);
    CHECK(camera.camera_to_world[2].y == Approx(std::cos(0.5)).epsilon(1e-9));
}

TEST_CASE("Looking around leaves the camera where it is", "[view]") {
    Camera camera = some_camera(false);
    const glm::dvec4 eye = camera.camera_to_world[3];
    const double back = camera.camera_to_world[2].y;
    look(camera, 0.3, 0.2);
    CHECK(glm::length(camera.camera_to_world[3] - eye) < 1e-12);
    CHECK(camera.camera_to_world[2].y < back);  // it looks higher
}

TEST_CASE("Flying follows the camera's own axes", "[view]") {
    Camera camera = some_camera(false);
    const Camera before = camera;
    fly(camera, {1, 2, 3});
    const glm::dvec3 local(glm::inverse(before.camera_to_world) * camera.camera_to_world[3]);
    CHECK(glm::length(local - glm::dvec3(1, 2, -3)) < 1e-12);
}

TEST_CASE("Panning keeps the point under the cursor", "[view]") {
    for (const bool orthographic : {false, true}) {
        Camera camera = some_camera(orthographic);
        const double aspect = 1.6;
        const glm::dvec2 from(0.3, 0.4);
        const glm::dvec2 to(0.8, 0.1);
        const glm::dvec3 point = point_seen(camera, from, aspect, 4);
        CHECK(glm::length(seen_at(camera, point, aspect) - from) < 1e-9);
        pan(camera, from, to, aspect, depth_of(camera, point, 1e-6));
        CHECK(glm::length(seen_at(camera, point, aspect) - to) < 1e-9);
    }
}

TEST_CASE("A dolly goes nearer but never through", "[view]") {
    const glm::dvec3 pivot(0.5, 1, -1);
    Camera camera = some_camera(false);
    const double distance = glm::length(glm::dvec3(camera.camera_to_world[3]) - pivot);
    dolly(camera, pivot, 0.5, 10);
    CHECK(glm::length(glm::dvec3(camera.camera_to_world[3]) - pivot) == Approx(distance / 2).epsilon(1e-12));
    for (int i = 0; i < 200; ++i) {
        dolly(camera, pivot, 0.5, 10);
    }
    CHECK(glm::length(glm::dvec3(camera.camera_to_world[3]) - pivot) == Approx(1e-5).epsilon(1e-6));
    Camera flat = some_camera(true);
    dolly(flat, pivot, 0.5, 10);
    CHECK(flat.orthographic_height == Approx(1.25).epsilon(1e-12));
}

TEST_CASE("Focus lies in the plane of the point", "[view]") {
    for (const bool orthographic : {false, true}) {
        Camera camera = some_camera(orthographic);
        const glm::dvec3 point = point_seen(camera, {0.1, 0.9}, 1.6, 7);
        REQUIRE(focus_on(camera, point));
        const glm::dvec3 local(glm::inverse(camera.camera_to_world) * glm::dvec4(point, 1));
        CHECK(camera.lens.focus_distance == Approx(-local.z).epsilon(1e-12));
        CHECK(!focus_on(camera, glm::dvec3(camera.camera_to_world * glm::dvec4(0, 0, 1, 1))));
        CHECK(camera.lens.focus_distance == Approx(-local.z).epsilon(1e-12));
    }
}

TEST_CASE("The field of view has limits", "[view]") {
    Camera camera = some_camera(false);
    set_field_of_view(camera, 100, 3);
    CHECK(camera.vertical_fov == Approx(179 * pi / 180));
    set_field_of_view(camera, 0, 3);
    CHECK(camera.vertical_fov == Approx(0.001 * pi / 180));
    Camera flat = some_camera(true);
    set_field_of_view(flat, pi / 2, 3);
    CHECK(flat.orthographic_height == Approx(6));
}

TEST_CASE("A viewpoint puts a camera back where it was", "[view]") {
    for (const bool orthographic : {false, true}) {
        Camera camera = some_camera(orthographic);
        orbit(camera, {0, 0, 0}, 1.1, 0.4);
        Camera again = some_camera(orthographic);
        again.node = 3;
        place_at(viewpoint_of(camera, 2), again);
        CHECK(difference(camera, again) < 1e-12);
        CHECK(again.node == none);
        CHECK(again.vertical_fov == Approx(camera.vertical_fov));
        CHECK(again.orthographic_height == camera.orthographic_height);
        // Rolled, which +Y cannot say.
        const glm::dmat4 rolled = camera.camera_to_world;
        camera.camera_to_world[0] = rolled[1];
        camera.camera_to_world[1] = -rolled[0];
        CHECK(viewpoint_of(camera, 2).up);
        place_at(viewpoint_of(camera, 2), again);
        CHECK(difference(camera, again) < 1e-12);
    }
}
