// Points on a scene's surfaces: what a camera sees, and where light is emitted.
#include <algorithm>
#include <cmath>

#include "catch.h"
#include "generate/shapes.h"
#include "scene/surface_points.h"

using namespace diptych::core;

namespace {

/// A square that faces +z, at depth z.
void add_screen(Scene& scene, float half, float z, int material) {
    Primitive out;
    out.material = material;
    add_quad(out, {-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z});
    out.uvs[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    add_object(scene, "screen", {out});
}

int add_color(Scene& scene, const char* name) {
    return add_material(scene, make_material(name, glm::vec3(0.5F), 0, 1));
}

std::vector<SurfacePoint> seen(const Scene& scene, const Camera& camera, int side = 16) {
    return seen_points(scene, peak_emissions(scene), camera, side);
}

}  // namespace

TEST_CASE("a view's points are what a ray through each pixel meets first", "[surface_points]") {
    Scene scene;
    const int far_color = add_color(scene, "far");
    const int near_color = add_color(scene, "near");
    add_screen(scene, 100, -2, far_color);
    add_screen(scene, 0.5F, 0, near_color);  // half the width and height of the view, at 1 metre
    Camera camera = make_camera("camera", {0, 0, 1}, {0, 0, 0}, 90);
    for (const bool orthographic : {false, true}) {
        camera.orthographic = orthographic;
        camera.orthographic_height = 2;
        const std::vector<SurfacePoint> points = seen(scene, camera);
        REQUIRE(points.size() == 256);
        CHECK(std::count_if(points.begin(), points.end(), [&](const auto& p) { return p.material == near_color; }) ==
              64);
        for (const SurfacePoint& point : points) {
            CHECK(point.position.z == Approx(point.material == near_color ? 0 : -2).margin(1e-12));
            CHECK(point.normal.z == Approx(1));
        }
    }
    // From behind, the normal still looks at the camera.
    const std::vector<SurfacePoint> back = seen(scene, make_camera("camera", {0, 0, -1}, {0, 0, 1}, 40));
    REQUIRE(back.size() == 256);
    CHECK(back[100].normal.z == Approx(-1));
    // A floor that runs under the camera and behind it.
    Scene ground;
    Primitive level;
    level.material = add_color(ground, "ground");
    add_quad(level, {-1e4F, 0, 1e4F}, {1e4F, 0, 1e4F}, {1e4F, 0, -1e4F}, {-1e4F, 0, -1e4F});
    add_object(ground, "ground", {level});
    CHECK(seen(ground, make_camera("camera", {0, 1, 0}, {0, 1, -1}, 90)).size() == 128);
    CHECK(seen(ground, make_camera("camera", {0, 1, 0}, {0, 2, 0.001}, 90)).empty());
}

TEST_CASE("a view looks through what is cut out", "[surface_points]") {
    Scene scene;
    const int wall = add_color(scene, "wall");
    const int leaf = add_color(scene, "leaf");
    add_screen(scene, 100, -2, wall);
    add_screen(scene, 100, 0, leaf);
    // The upper half of the image is opaque.
    TextureImage image;
    image.width = 1;
    image.height = 2;
    image.rgba = {255, 255, 255, 255, 255, 255, 255, 0};
    scene.images.push_back(image);
    scene.textures.emplace_back().image = 0;
    Material& material = scene.materials[static_cast<std::size_t>(leaf)];
    material.base_color_texture.texture = 0;
    const Camera camera = make_camera("camera", {0, 0, 1}, {0, 0, 0}, 90);
    const auto leaves = [&] {
        const std::vector<SurfacePoint> points = seen(scene, camera);
        return std::count_if(points.begin(), points.end(), [&](const auto& p) { return p.material == leaf; });
    };
    CHECK(leaves() == 256);
    for (const AlphaMode mode : {AlphaMode::mask, AlphaMode::blend}) {
        material.alpha_mode = mode;
        CHECK(leaves() == 128);
    }
    CHECK(seen(scene, camera).size() == 256);
}

TEST_CASE("emitting points stand for all of the emitters' area, as bright as they are", "[surface_points]") {
    Scene scene;
    add_screen(scene, 1, 0, add_material(scene, make_emitter("bright", glm::vec3(9))));
    add_screen(scene, 3, -1, add_material(scene, make_emitter("dim", glm::vec3(1))));
    add_screen(scene, 5, -2, add_color(scene, "dark"));
    scene.instances[1].object_to_world = glm::dmat4(-1);  // mirrored: what is its front stays its front
    scene.instances[1].object_to_world[3][3] = 1;
    const std::vector<SurfacePoint> points = emitting_points(scene, peak_emissions(scene), 1000);
    CHECK(points.size() == 1000);
    double area[2] = {};
    double power[2] = {};
    for (const SurfacePoint& point : points) {
        area[point.material] += point.area;
        power[point.material] += point.area * point.emission;
        CHECK(point.normal.z == Approx(point.material == 0 ? 1 : -1));
    }
    CHECK(area[0] == Approx(4).epsilon(0.002));
    CHECK(area[1] == Approx(36).epsilon(0.002));
    CHECK(power[0] == Approx(36).epsilon(0.002));
    CHECK(power[1] == Approx(36).epsilon(0.002));
}

TEST_CASE("numbers that are none neither stop nor enter the points", "[surface_points]") {
    Scene scene;
    const int lamp = add_material(scene, make_emitter("lamp", glm::vec3(2)));
    add_screen(scene, 1, 0, lamp);
    add_screen(scene, NAN, 0, lamp);
    add_screen(scene, INFINITY, 0, lamp);
    add_screen(scene, 1e30F, -1, add_color(scene, "huge"));
    for (const SurfacePoint& point : emitting_points(scene, peak_emissions(scene), 100)) {
        CHECK(std::isfinite(glm::length(point.position)));
    }
    const std::vector<SurfacePoint> points = seen(scene, make_camera("camera", {0, 0, 3}, {0, 0, 0}, 45));
    CHECK(points.size() == 256);
    for (const SurfacePoint& point : points) {
        CHECK(glm::length(point.normal) == Approx(1));
    }
}
