// Whole files' worth of extremes: nested nodes with translations, cameras near and far, sizes up to 10^±80. Each either
// renders as the oracle has it or is refused with one error that names the object.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "error.h"
#include "geometry_fixture.h"
#include "pack/linear_part.h"
#include "scene/default_camera.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

constexpr int film_side = 4;
constexpr std::uint32_t samples = 64;

double size_of(const Bounds& bounds) {
    return is_empty(bounds) ? 0 : glm::length(bounds.hi - bounds.lo);
}

/// Sees the scene whole, from its own size away or from thousands of it.
Camera near_or_far(const Scene& scene, std::mt19937_64& random) {
    const Bounds bounds = scene_bounds(scene);
    const double size = std::max(size_of(bounds), 1e-30);
    const double distance = size * std::pow(10, std::uniform_real_distribution<double>(0.3, 4)(random));
    const glm::dvec3 middle = is_empty(bounds) ? glm::dvec3(0) : 0.5 * bounds.lo + 0.5 * bounds.hi;
    std::normal_distribution<double> normal;
    const glm::dvec3 away = glm::normalize(glm::dvec3{normal(random), normal(random), normal(random)});
    Camera camera = make_camera("camera", middle + distance * away, middle, 45);
    camera.orthographic = random() % 2 == 0;
    camera.orthographic_height = size;
    camera.vertical_fov = 2 * std::atan(0.5 * size / distance);
    return camera;
}

Scene extreme_scene(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    Scene scene;
    scene.name = "extreme";
    add_material(scene, lamp_material());
    const int shapes = 1 + static_cast<int>(random() % 2);
    for (int i = 0; i < shapes; ++i) {
        glm::dmat4 to_world(1);
        for (int node = 0; node < 2; ++node) {
            glm::dmat4 local(random_chain(random));
            local[3] = glm::dvec4{normal(random), normal(random), normal(random), 1};
            to_world = to_world * local;
        }
        add_object(scene, "shape " + std::to_string(i), {random_shape(random, 0)}, to_world);
        if (random() % 4 == 0) {
            scene.instances.back().node = static_cast<int>(scene.nodes.size());
            scene.nodes.emplace_back();
        }
    }
    scene.cameras.push_back(near_or_far(scene, random));
    return scene;
}

/// By how much of the view the panels may differ: where a shape moves, its outline may err by its thickness
/// (docs/decisions/0015).
double allowance(const Scene& scene) {
    const auto moves = [](const Instance& instance) { return instance.node != none; };
    if (std::none_of(scene.instances.begin(), scene.instances.end(), moves)) {
        return 2e-3;
    }
    const Camera& camera = scene.cameras.front();
    const Bounds bounds = scene_bounds(scene);
    const glm::dvec3 middle = is_empty(bounds) ? glm::dvec3(0) : 0.5 * bounds.lo + 0.5 * bounds.hi;
    return 2e-3 + least_thickness(glm::length(glm::dvec3(camera.camera_to_world[3]) - middle) / camera.orthographic_height);
}

enum class Outcome { alike, refused };

Outcome judge(std::uint64_t seed, bool on_device) {
    const Scene scene = extreme_scene(seed);
    const RenderSettings settings = geometry_settings(film_side, film_side, 1);
    PackedScene packed;
    try {
        packed = pack_scene(scene, settings);
    } catch (const Error& error) {
        const std::string what = error.what();
        CHECK(what.rfind("extreme: ", 0) == 0);
        CHECK((what.find("instance 'shape") != std::string::npos || what.find("camera 'camera'") != std::string::npos));
        return Outcome::refused;
    }
    Films films;
    films.cpu = render_cpu(packed, samples);
    films.vulkan = on_device ? render_vulkan(packed, samples) : films.cpu;
    films.oracle = render_oracle(scene, settings, 4 * samples);
    CHECK(count_nonfinite(films) == 0);
    const MeanAndError cpu = mean_of(films.cpu);
    const MeanAndError vulkan = mean_of(films.vulkan);
    const MeanAndError oracle = mean_of(films.oracle);
    INFO("cpu " << cpu.mean << " ± " << cpu.error << " vulkan " << vulkan.mean << " oracle " << oracle.mean << " ± "
                << oracle.error);
    CHECK(std::abs(cpu.mean - oracle.mean) < 5 * std::hypot(cpu.error, oracle.error) + 2e-3);
    CHECK(std::abs(vulkan.mean - cpu.mean) < allowance(scene));
    return Outcome::alike;
}

void judge_all(int scenes, int every) {
    int refused = 0;
    for (int i = 0; i < scenes; ++i) {
        INFO("scene " << i);
        refused += judge(static_cast<std::uint64_t>(i) + 1, i % every == 0) == Outcome::refused ? 1 : 0;
    }
    std::printf("%d scenes, %d of them refused\n", scenes, refused);
    CHECK(refused < scenes * 3 / 4);
    CHECK(refused > scenes / 20);
}

}  // namespace

TEST_CASE("Extreme transforms and cameras render as the oracle has them or are refused") {
    NEED_VULKAN();
    judge_all(400, 20);
}

TEST_CASE("Two thousand extreme transforms and cameras on both panels", "[nightly]") {
    NEED_VULKAN();
    judge_all(2000, 1);
}
