// Camera rays and the equirectangular map.
#include "geometry/camera.h"

#include "catch.h"
#include "close.h"
#include "lights/environment_mapping.h"
#include "numbers/rng.h"

#include <cmath>

using namespace diptych::core::shared;
using diptych::core::tests::close;

namespace {

Camera camera(uint kind) {
    Camera c;
    c.origin = vec3(1, 2, 3);
    c.kind = kind;
    c.right = vec3(0.8f, 0, 0);
    c.lens_radius = 0.1f;
    c.up = vec3(0, 0.5f, 0);
    c.focus_distance = 4;
    c.forward = vec3(0, 0, -1);
    return c;
}

struct Ray {
    vec3 origin;
    vec3 direction;
};

Ray trace(const Camera& c, vec2 film, vec2 lens, bool thin_lens, bool orthographic_allowed) {
    Ray ray;
    camera_ray(c, film, lens, thin_lens, orthographic_allowed, ray.origin, ray.direction);
    return ray;
}

const vec2 centre(0.5f, 0.5f);
const vec2 unturned(1, 0);

}  // namespace

TEST_CASE("A pinhole sees along the film's point, y down") {
    const Ray middle = trace(camera(CAMERA_PERSPECTIVE), centre, centre, false, false);
    CHECK(middle.origin == vec3(1, 2, 3));
    CHECK(middle.direction == vec3(0, 0, -1));
    const Ray corner = trace(camera(CAMERA_PERSPECTIVE), vec2(0, 0), centre, false, false);
    CHECK(length(corner.direction - normalize(vec3(-0.8f, 0.5f, -1))) < 1e-6f);
    CHECK(std::abs(length(corner.direction) - 1) < 1e-6f);
}

TEST_CASE("A thin lens keeps the plane of focus sharp and starts around the pinhole's ray") {
    for (const uint kind : {CAMERA_PERSPECTIVE, CAMERA_ORTHOGRAPHIC}) {
        CAPTURE(kind);
        const Camera c = camera(kind);
        const vec2 film(0.8f, 0.3f);
        const Ray pinhole = trace(c, film, centre, false, true);
        const vec3 focus = pinhole.origin + pinhole.direction * (c.focus_distance / -pinhole.direction.z);
        double widest = 0;
        for (uint i = 0; i < 1000; i++) {
            const uvec4 v = pcg4d(uvec4(i, 0, 0, 0));
            const Ray ray = trace(c, film, vec2(unit_float(v.x), unit_float(v.y)), true, true);
            const vec3 shift = ray.origin - pinhole.origin;
            REQUIRE(std::abs(shift.z) < 1e-6f);
            REQUIRE(std::abs(length(ray.direction) - 1) < 1e-6f);
            widest = std::max(widest, double(length(shift)));
            REQUIRE(length(ray.origin + ray.direction * (c.focus_distance / -ray.direction.z) - focus) < 5e-6f);
        }
        CHECK(widest <= 0.1 + 1e-6);
        CHECK(widest > 0.095);
    }
}

TEST_CASE("Lens and projection count only where allowed") {
    const Ray off = trace(camera(CAMERA_PERSPECTIVE), centre, vec2(0.9f, 0.9f), false, false);
    CHECK(off.origin == vec3(1, 2, 3));
    Camera far_focus = camera(CAMERA_PERSPECTIVE);
    far_focus.focus_distance = INFINITY;
    CHECK(trace(far_focus, centre, vec2(0.9f, 0.9f), true, false).direction == vec3(0, 0, -1));
    const Ray flat = trace(camera(CAMERA_ORTHOGRAPHIC), vec2(1, 0), vec2(0.9f, 0.9f), false, true);
    CHECK(length(flat.origin - vec3(1.8f, 2.5f, 3)) < 1e-6f);
    CHECK(flat.direction == vec3(0, 0, -1));
    CHECK(trace(camera(CAMERA_ORTHOGRAPHIC), vec2(1, 0), centre, false, false).origin == vec3(1, 2, 3));
}

TEST_CASE("camera_project finds the film's point that a ray sees along, and no point behind the camera") {
    for (const uint kind : {CAMERA_PERSPECTIVE, CAMERA_ORTHOGRAPHIC}) {
        CAPTURE(kind);
        const Camera c = camera(kind);
        for (uint i = 0; i < 100; i++) {
            const uvec4 v = pcg4d(uvec4(i, 4, 5, 6));
            const vec2 film(unit_float(v.x), unit_float(v.y));
            const Ray ray = trace(c, film, centre, false, true);
            vec2 found;
            REQUIRE(camera_project(c, ray.origin + (0.1f + 9 * unit_float(v.z)) * ray.direction, found));
            REQUIRE(length(found - film) < 2e-6f);
            REQUIRE(!camera_project(c, ray.origin - 0.1f * ray.direction, found));
        }
    }
}

TEST_CASE("The environment's centre looks along -Z, u grows toward +X, v down from +Y") {
    CHECK(environment_uv(vec3(0, 0, -1), unturned) == vec2(0.5f, 0.5f));
    CHECK(environment_uv(vec3(1, 0, 0), unturned) == vec2(0.75f, 0.5f));
    CHECK(environment_uv(vec3(-2, 0, 0), unturned) == vec2(0.25f, 0.5f));
    CHECK(environment_uv(vec3(0, 1, 0), unturned).y == 0);
    CHECK(environment_uv(vec3(0, -1, 0), unturned).y == 1);
    const vec2 seam = environment_uv(vec3(0, 0, 1), unturned);
    CHECK((seam.x == 0 || seam.x > 0.9999f));
    CHECK(seam.x < 1);
}

TEST_CASE("A quarter turn brings the map's centre from -Z to -X") {
    const vec2 quarter(0, 1);  // counter-clockwise from above: -Z turns to -X
    CHECK(length(environment_direction(centre, quarter) - vec3(-1, 0, 0)) < 1e-6f);
    CHECK(length(environment_uv(vec3(-1, 0, 0), quarter) - centre) < 1e-6f);
}

TEST_CASE("environment_uv and environment_direction are inverse, near the poles too") {
    const vec2 turn(0.6f, 0.8f);
    for (uint i = 0; i < 100000; i++) {
        const uvec4 v = pcg4d(uvec4(i, 1, 2, 3));
        const vec2 uv(unit_float(v.x), i % 2 == 0 ? unit_float(v.y) : unit_float(v.y) * 1e-3f);
        const vec3 w = environment_direction(uv, turn);
        REQUIRE(std::abs(length(w) - 1) < 1e-6f);
        REQUIRE(length(environment_direction(environment_uv(w, turn), turn) - w) < 2e-6f);
        const float apart = std::abs(environment_uv(w, turn).x - uv.x);
        REQUIRE(std::min(apart, 1 - apart) * std::sin(PI * uv.y) < 1e-6f);
    }
}

TEST_CASE("The environment's pdf integrates to 1 over the sphere") {
    const uvec2 size(8, 4);
    double sum = 0;
    constexpr int steps = 2000;
    for (int i = 0; i < steps; i++) {
        const double theta = 3.141592653589793 * (i + 0.5) / steps;
        const double texel_pmf = i < steps / 4 ? 1.0 / 8 : 0;  // the top row holds it all
        sum += double(pdf_environment_solid_angle(float(texel_pmf), size, float(std::sin(theta)))) * std::sin(theta) *
               2 * 3.141592653589793 * 3.141592653589793 / steps;
    }
    CHECK(close(sum, 1, 1e-5));
    CHECK(pdf_environment_solid_angle(0.1f, size, 0) == 0);
}
