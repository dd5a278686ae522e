// A handful of the mutants, quickly: this one file holds them all beside the right code, and two tiny closed forms tell
// each from it. The whole list: run.sh.
#ifndef DIPTYCH_MUTANT
#define DIPTYCH_MUTANT
#endif
#include <cmath>
#include <numbers>

#include "../cpu/lambert.h"
#include "../cpu/render_fixture.h"
#include "backend/cpu_kernel.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

/// Of this file alone, so that the kernel below is too, and no linker takes another file's copy of it.
struct Tracer : PlainTracer {};
using Kernel = shared::CpuKernel<Tracer, ~0U>;

constexpr double albedo = 0.5;

/// Mean and standard error of all pixels' samples, red.
struct Estimate {
    double mean = 0;
    double error = 0;
};

Estimate estimate(const Scene& scene, Integrator integrator, LightSampler light_sampler, std::uint32_t depth,
                  std::uint32_t spp) {
    RenderSettings settings = statistical_settings(16, 16, integrator, depth);
    settings.light_sampler = light_sampler;
    const PackedScene packed = pack_scene(scene, settings);
    const EmbreeScene embree(packed);
    Kernel kernel{packed, packed.constants, Tracer{{embree}}};
    double sum = 0;
    double squares = 0;
    for (std::uint32_t pixel = 0; pixel < 256; ++pixel) {
        for (std::uint32_t i = 0; i < spp; ++i) {
            const auto x = double{kernel.trace_path({pixel % 16, pixel / 16}, i).radiance.x};
            sum += x;
            squares += x * x;
        }
    }
    const double n = 256.0 * spp;
    const double mean = sum / n;
    return {mean, std::sqrt(std::max(squares / n - mean * mean, 0.0) / n) + 1e-6};
}

/// Below a lamp; beside it one that a plate hides in the last hundredth of the way, and one that turns its back.
Scene lamps() {
    Scene scene;
    scene.name = "lamps";
    const int floor = add_material(scene, diffuse_material(static_cast<float>(albedo)));
    const int light = add_material(scene, make_emitter("light", glm::vec3(1)));
    const int black = add_material(scene, diffuse_material(0));
    add_object(scene, "floor", {horizontal_square(glm::vec3(0), 20, true, floor)});
    add_object(scene, "turned", {horizontal_square({0, 1, 1.5F}, 0.4F, true, light)});
    add_object(scene, "hidden", {horizontal_square({1.5F, 1, 0}, 0.3F, false, light)});
    add_object(scene, "lamp", {horizontal_square({0, 1, 0}, 0.5F, false, light)});
    add_object(scene, "plate", {horizontal_square({1.5F, 0.996F, 0}, 0.32F, false, black)});
    scene.cameras.push_back(point_camera({0.6, 0.4, 0.3}, {0, 0, 0}));
    return scene;
}

/// Every wall emits and reflects.
Scene furnace() {
    Scene scene;
    scene.name = "furnace";
    Material glow = diffuse_material(static_cast<float>(albedo));
    glow.emission = glm::vec3(0.25F);
    Primitive room;
    room.material = add_material(scene, glow);
    add_box(room, {-1, -1, -1}, {1, 1, 1});
    for (glm::uvec3& t : room.triangles) {
        std::swap(t.y, t.z);
    }
    add_object(scene, "room", {room});
    scene.cameras.push_back(make_camera("camera", {0.1, 0.2, 0.7}, {0, -0.1, -1}, 60));
    return scene;
}

/// How far from the truth, in standard errors; the worst of the closed forms and integrators.
double worst_departure() {
    const Polygon square = {{-0.5, 1, -0.5}, {0.5, 1, -0.5}, {0.5, 1, 0.5}, {-0.5, 1, 0.5}};
    const double lamp = albedo / std::numbers::pi * polygon_irradiance(square, {0, 1, 0});
    double worst = 0;
    for (int i = 0; i < 6; ++i) {
        const Integrator integrator = integrators.at(static_cast<std::size_t>(i / 2));
        const LightSampler light_sampler = i % 2 == 0 ? LightSampler::power : LightSampler::spatial;
        const Estimate floor = estimate(lamps(), integrator, light_sampler, 1, 256);
        worst = std::max(worst, std::abs(floor.mean - lamp) / floor.error);
        for (const std::uint32_t depth : {2U, 6U}) {
            const Estimate wall = estimate(furnace(), integrator, light_sampler, depth, 64);
            const double truth = 0.25 * (1 - std::pow(albedo, depth + 1.0)) / (1 - albedo);
            worst = std::max(worst, std::abs(wall.mean - truth) / wall.error);
        }
    }
    return worst;
}

}  // namespace

TEST_CASE("A handful of mutants fail closed forms that the right code passes") {
    mutants::chosen = -1;
    CHECK(worst_departure() < 4.5);
    for (const std::string name : {"DROP_COSINE", "ONE_SIDED_AS_TWO_SIDED", "NO_LIGHT_PICK_PDF", "ALIAS_SWAPPED",
                                   "MIS_ONE_AT_LIGHT", "MIS_ONE_AT_HIT", "ROULETTE_NOT_DIVIDED", "EMISSION_TWICE",
                                   "SHORT_SHADOW_RAY", "SHADOW_RAY_TO_WRONG_LIGHT", "DEPTH_OFF_BY_ONE",
                                   "TREE_HIT_BY_POWER"}) {
        mutants::chosen = mutants::find(name.c_str());
        const double departure = worst_departure();
        std::printf("%-26s %.1f standard errors off\n", name.c_str(), departure);
        INFO(name << ": " << departure << " standard errors off");
        CHECK(departure > 8);
    }
    mutants::chosen = -1;
}
