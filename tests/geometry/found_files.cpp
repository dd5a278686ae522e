// Files on which a panel was wrong or ended the program, and the same cases made here.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "geometry_fixture.h"
#include "pack/features.h"
#include "scene/default_camera.h"
#include "scene/environment_load.h"
#include "gltf/import.h"
#include "pose/pose.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

std::filesystem::path found_folder() {
    const char* given = std::getenv("DIPTYCH_ASSETS");
    const std::filesystem::path assets =
        given != nullptr ? std::filesystem::path(given) : std::filesystem::path(DIPTYCH_SOURCE_DIR) / "../shared/assets";
    return assets / "found/geometry";
}

void complete(Scene& scene) {
    const bool shines = std::any_of(scene.materials.begin(), scene.materials.end(), emits);
    if (!shines && scene.lights.empty()) {
        scene.environment = neutral_sky();
    }
    if (scene.cameras.empty()) {
        scene.cameras.push_back(frame_scene(scene));
    }
}

/// By 8x8 tiles. `rounding`: of a tile.
void check_alike(const Films& films, double rounding = 1e-4) {
    CHECK(count_nonfinite(films) == 0);
    for (int y = 0; y + 8 <= films.cpu.height; y += 8) {
        for (int x = 0; x + 8 <= films.cpu.width; x += 8) {
            const MeanAndError cpu = mean_of(films.cpu, x, y, 8, 8);
            const MeanAndError vulkan = mean_of(films.vulkan, x, y, 8, 8);
            const MeanAndError oracle = mean_of(films.oracle, x, y, 8, 8);
            INFO("tile " << x << "," << y << ": cpu " << cpu.mean << " vulkan " << vulkan.mean << " oracle "
                         << oracle.mean << " ± " << oracle.error);
            CHECK(std::abs(cpu.mean - oracle.mean) < 5 * std::hypot(cpu.error, oracle.error) + rounding);
            CHECK(std::abs(vulkan.mean - cpu.mean) < 1e-3 * cpu.mean + rounding);
        }
    }
}

/// A level white square that a node scales to zero height and back while another turns it.
Scene collapsing_scene() {
    Scene scene;
    scene.name = "collapsing";
    add_material(scene, white_material());
    add_object(scene, "ball", {make_sphere(1, 24, 16, 0)});
    scene.lights.push_back(sun_along({0.3, -1, -0.6}));
    Camera camera = make_camera("camera", {0, 4, 4}, {0, 0, 0}, 30);
    scene.cameras.push_back(camera);
    Node stretched;
    Node turned;
    turned.parent = 0;
    turned.rotation = {std::sin(0.4), 0, 0, std::cos(0.4)};
    scene.nodes = {stretched, turned};
    scene.instances[0].node = 1;
    scene.animations.emplace_back();
    scene.animations[0].channels.push_back(
        {AnimatedProperty::scale, 0, Interpolation::linear, {0, 2}, {1, 1, 1, 1, -1, 1}});
    return scene;
}

}  // namespace

TEST_CASE("The found files of flattened geometry are what the oracle shows") {
    NEED_VULKAN();
    if (!std::filesystem::is_directory(found_folder())) {
        SKIP_TEST("no ../shared/assets/found/geometry");
    }
    for (const auto& entry : std::filesystem::directory_iterator(found_folder())) {
        const std::string name = entry.path().stem().string();
        if (entry.path().extension() != ".glb" || name == "bevy-cornell") {
            continue;
        }
        INFO(name);
        Scene scene = load_gltf(entry.path());
        complete(scene);
        const Films films = render_everywhere(scene, geometry_settings(32, 32, 2), 64);
        check_alike(films);
        CHECK(mean_of(films.cpu).mean > 1e-3);
        if (name == "zs_s0") {
            CHECK(mean_of(films.cpu, 12, 12, 8, 8).mean == Approx(0.5).margin(1e-3));
        }
    }
}

TEST_CASE("A scale that passes through 0 is drawn at every moment") {
    NEED_VULKAN();
    Scene scene = collapsing_scene();
    const RenderSettings settings = geometry_settings(32, 32, 1);
    PackedScene packed = pack_scene(scene, settings);
    for (const double seconds : {0.0, 0.9, 0.9995, 1.0, 1.0 + 1e-7, 1.5}) {
        INFO(seconds << " s");
        pose_scene(scene, seconds);
        pack_moment(scene, settings, packed);
        const Films films = {render_cpu(packed, 64), render_vulkan(packed, 64), render_oracle(scene, settings, 64)};
        check_alike(films, 2e-3);
        CHECK(mean_of(films.cpu).mean > 0.05);
    }
}

TEST_CASE("A flattened lamp shows the side that faces the camera") {
    NEED_VULKAN();
    for (const double thickness : {0.0, 1e-9, 1e-7, 1e-5, -1e-9}) {
        for (const bool moves : {false, true}) {
            INFO("thickness " << thickness << (moves ? ", moving" : ""));
            Scene scene;
            scene.name = "flat lamp";
            Primitive box;
            box.material = add_material(scene, make_emitter("lamp", glm::vec3(1)));  // from its front alone
            add_box(box, {-1, -1, -1}, {1, 1, 1});
            glm::dmat4 flat(1);
            flat[2][2] = thickness;
            add_object(scene, "box", {box}, flat);
            if (moves) {
                scene.instances.back().node = 0;
                scene.nodes.emplace_back();
            }
            scene.cameras.push_back(make_camera("camera", {1, 0.5, 5}, {0, 0, 0}, 40));
            const Films films = render_everywhere(scene, geometry_settings(32, 32, 0), 16);
            CHECK(mean_of(films.oracle).mean > 0.2);
            for (const Film* panel : {&films.cpu, &films.vulkan}) {
                CHECK(mean_of(*panel).mean == Approx(mean_of(films.oracle).mean).margin(5e-3));
            }
        }
    }
}

TEST_CASE("Of two triangles in one place both panels meet the first") {
    NEED_VULKAN();
    std::mt19937_64 random(11);
    Scene scene;
    scene.name = "twice";
    for (int i = 0; i < 2; ++i) {
        Material lamp = lamp_material();
        lamp.emission = glm::vec3(i == 0 ? 1.0F : 0.25F);
        add_material(scene, lamp);
    }
    Primitive bright;
    Primitive dim;
    for (int i = 0; i < 200; ++i) {
        std::uniform_real_distribution<float> place(-1, 1);
        const glm::vec3 a(place(random), place(random), place(random));
        const glm::vec3 b = a + 0.3F * glm::vec3(place(random), place(random), place(random));
        const glm::vec3 c = a + 0.3F * glm::vec3(place(random), place(random), place(random));
        for (Primitive* p : {&bright, &dim}) {
            const auto first = static_cast<std::uint32_t>(p->positions.size());
            p->positions.insert(p->positions.end(), {a, b, c});
            p->triangles.emplace_back(p == &dim ? glm::uvec3(first + 1, first + 2, first)
                                                : glm::uvec3(first, first + 1, first + 2));
        }
    }
    bright.material = 0;
    dim.material = 1;
    add_object(scene, "bright", {bright, dim});
    scene.cameras.push_back(make_camera("camera", {0, 0, 5}, {0, 0, 0}, 30));
    const Films films = render_everywhere(scene, geometry_settings(32, 32, 0), 64);
    check_alike(films);
    CHECK(mean_of(films.cpu).mean > 0.05);
}

TEST_CASE("A point light under a scale of 0 shines") {
    Node node;
    node.scale = glm::dvec3(0);
    const glm::dmat4 flat(glm::dmat3(0));
    CHECK(light_placement(PunctualType::point, {node}, 0, flat).has_value());
    node.rotation = {0, std::sin(0.25), 0, std::cos(0.25)};
    const std::optional<glm::dmat4> spot = light_placement(PunctualType::spot, {node}, 0, flat);
    REQUIRE(spot);
    CHECK(glm::length(glm::dvec3((*spot)[2]) - glm::dvec3(std::sin(0.5), 0, std::cos(0.5))) < 1e-12);
    node.matrix = flat;
    CHECK(!light_placement(PunctualType::spot, {node}, 0, flat));
    CHECK(light_placement(PunctualType::point, {node}, 0, flat).has_value());
}
