// Level L3: path by path from the same random numbers.
#include <cstdio>

#include "panels_fixture.h"
#include "measure/path_agreement.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

struct Pair {
    std::unique_ptr<PackedScene> packed_cpu;
    std::unique_ptr<PackedScene> packed_vulkan;
    std::unique_ptr<Renderer> cpu;
    std::unique_ptr<Renderer> vulkan;
};

Pair make_pair_of(const Scene& scene, const RenderSettings& cpu, const RenderSettings& vulkan) {
    Pair pair;
    pair.packed_cpu = std::make_unique<PackedScene>(pack_scene(scene, cpu));
    pair.packed_vulkan = std::make_unique<PackedScene>(pack_scene(scene, vulkan));
    pair.cpu = make_cpu_renderer(*pair.packed_cpu, 2);
    pair.vulkan = make_vulkan_renderer(panels_gpu(), *pair.packed_vulkan);
    return pair;
}

PairedReport compare_paths(Pair& pair, const RenderSettings& settings, std::uint32_t spp) {
    std::vector<shared::PathQuery> queries;
    for (std::uint32_t y = 0; y < static_cast<std::uint32_t>(settings.height); ++y) {
        for (std::uint32_t x = 0; x < static_cast<std::uint32_t>(settings.width); ++x) {
            for (std::uint32_t s = 0; s < spp; ++s) {
                queries.push_back({{x, y}, s});
            }
        }
    }
    PairedTest test;
    test.add(queries, pair.cpu->summarize_paths(queries), pair.vulkan->summarize_paths(queries));
    return test.report();
}

void print(const std::string& name, const RenderSettings& settings, const PairedReport& report) {
    double most = 0;
    for (const PairedBounce& bounce : report.bounces) {
        most = std::max(most, static_cast<double>(bounce.parted) /
                                  static_cast<double>(std::max<std::uint64_t>(bounce.reached, 1)));
    }
    const auto& z = report.divergent_z;
    std::printf("%-14s %-6s %8llu paths, parted %llu (at most %.1e a bounce), drifted %llu (worst %.1e), z %.2f %.2f "
                "%.2f: %s %s\n",
                name.c_str(), name_of(settings.integrator), static_cast<unsigned long long>(report.paths),
                static_cast<unsigned long long>(report.paths - report.alike), most,
                static_cast<unsigned long long>(report.drifted), report.worst_relative, z[0], z[1], z[2],
                name_of(report.verdict), report.reason.c_str());
}

/// A lamp with a shade so close before it that a shadow ray cut short by a hundredth would miss it.
Scene shaded_lamp() {
    Scene scene;
    scene.name = "shaded lamp";
    const int grey = add_material(scene, diffuse_material(0.7F));
    const int light = add_material(scene, make_emitter("lamp", {1, 1, 1}));
    add_object(scene, "floor", {horizontal_square(glm::vec3(0), 2, true, grey)});
    add_object(scene, "lamp", {horizontal_square(glm::vec3(0, 1, 0), 0.25F, false, light)});
    add_object(scene, "shade", {horizontal_square(glm::vec3(0, 0.995F, 0), 0.15F, true, grey)});
    scene.cameras.push_back(make_camera("camera", {0, 0.6, 3}, {0, 0.5, 0}, 45));
    return scene;
}

void check_scene(const std::string& name, const Scene& scene, const RenderSettings& settings, std::uint32_t spp) {
    Pair pair = make_pair_of(scene, settings, settings);
    const PairedReport report = compare_paths(pair, settings, spp);
    print(name, settings, report);
    INFO(name << " " << name_of(settings.integrator) << ": " << report.reason);
    CHECK(report.verdict == PairedVerdict::pass);
}

}  // namespace

TEST_CASE("Paths on both panels decide alike from the same random numbers") {
    NEED_VULKAN();
    for (const std::string name : {"cornell", "veach-mis", "brdf-grid", "courtyard"}) {
        check_scene(name, load_own_scene(name), paired_settings(32, 24, Integrator::path, BrdfModel::ggx), 16);
    }
    check_scene("shaded lamp", shaded_lamp(), paired_settings(32, 24, Integrator::path, BrdfModel::ggx), 16);
}

TEST_CASE("All paths on both panels decide alike, on every scene of ours", "[nightly]") {
    NEED_VULKAN();
    for (const std::string& name : own_scenes()) {
        for (const Integrator integrator : integrators) {
            check_scene(name, load_own_scene(name), paired_settings(128, 96, integrator, BrdfModel::ggx), 32);
        }
    }
}

TEST_CASE("Vertices recorded on both panels are the same") {
    NEED_VULKAN();
    const Scene scene = load_own_scene("cornell");
    const RenderSettings settings = paired_settings(16, 12, Integrator::path, BrdfModel::ggx);
    Pair pair = make_pair_of(scene, settings, settings);
    std::vector<shared::PathQuery> queries;
    for (std::uint32_t i = 0; i < 64; ++i) {
        queries.push_back({{i % 16, i / 16 + 4}, i});
    }
    const std::vector<RecordedPath> cpu = pair.cpu->record_paths(queries);
    const std::vector<RecordedPath> vulkan = pair.vulkan->record_paths(queries);
    const std::vector<shared::PathSummary> summaries = pair.vulkan->summarize_paths(queries);
    std::size_t vertices = 0;
    std::size_t together = 0;
    for (std::size_t i = 0; i < queries.size(); ++i) {
        together += find_parting(cpu[i], vulkan[i], 1e-3) ? 0 : 1;
        vertices += cpu[i].vertices.size();
        CHECK(summaries[i].vertices == vulkan[i].vertices.size());
        CHECK(summaries[i].radiance == vulkan[i].radiance);
    }
    CHECK(vertices > 2 * queries.size());
    CHECK(together >= queries.size() - 1);  // one may part at an edge
}

TEST_CASE("The paired gate sees another seed, and a light that is brighter on one panel") {
    NEED_VULKAN();
    const Scene scene = load_own_scene("cornell");
    const RenderSettings settings = paired_settings(24, 18, Integrator::path, BrdfModel::ggx);
    RenderSettings other = settings;
    other.seed += 1;
    Pair pair = make_pair_of(scene, settings, other);
    CHECK(compare_paths(pair, settings, 8).verdict == PairedVerdict::fail);

    pair.packed_vulkan = std::make_unique<PackedScene>(pack_scene(scene, settings));
    for (shared::EmissiveTriangle& light : pair.packed_vulkan->emissive_triangles) {
        light.radiance *= 1.002F;
    }
    pair.vulkan = make_vulkan_renderer(panels_gpu(), *pair.packed_vulkan);
    const PairedReport brighter = compare_paths(pair, settings, 8);
    CHECK(brighter.verdict == PairedVerdict::fail);
    CHECK(brighter.drifted > brighter.paths / 10);
}
