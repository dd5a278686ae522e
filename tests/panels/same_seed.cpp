// With the same random numbers, nearly every pixel of both panels is equal to 1e-3.
#include <cstdio>

#include "panels_fixture.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

void check_pair(const std::string& name, const Scene& scene, const RenderSettings& settings, std::uint32_t spp,
                double least) {
    const Film cpu = render_cpu(scene, settings, spp);
    const Film vulkan = render_vulkan(scene, settings, spp);
    const double equal = fraction_equal(cpu, vulkan);
    const PairedDifference d = paired_difference(cpu, vulkan);
    std::printf("%-34s %-6s %-11s equal %.4f  z %.2f  difference of means %.1e\n", name.c_str(),
                name_of(settings.integrator), name_of(settings.brdf), equal, d.z, d.z * d.relative_error);
    INFO(name << " " << name_of(settings.integrator) << " " << name_of(settings.brdf) << " equal " << equal);
    CHECK(equal >= least);
    CHECK(d.z < 4.5);
    CHECK(film_totals(cpu).nonfinite == 0);
    CHECK(film_totals(vulkan).nonfinite == 0);
    CHECK(film_totals(vulkan).samples == film_totals(cpu).samples);
}

}  // namespace

TEST_CASE("Both panels paint our own scenes alike from one seed") {
    NEED_VULKAN();
    for (const std::string& name : own_scenes()) {
        const Scene scene = load_own_scene(name);
        // Lavapipe: all of 768 pixels but one at most, and eight on the normal map.
        const double least = name == "normal-map" ? 0.98 : 0.995;
        for (const Integrator integrator : integrators) {
            check_pair(name, scene, paired_settings(32, 24, integrator, BrdfModel::ggx), 4, least);
        }
        check_pair(name, scene, paired_settings(32, 24, Integrator::path, BrdfModel::blinn_phong), 4, least);
    }
}

TEST_CASE("Both panels paint awkward lights and materials alike from one seed") {
    NEED_VULKAN();
    for (const auto& [name, scene] : agreement_scenes()) {
        for (const Integrator integrator : {Integrator::brdf, Integrator::path}) {
            check_pair(name, scene, paired_settings(32, 24, integrator, BrdfModel::ggx), 4, 0.995);
        }
    }
}

TEST_CASE("Both panels paint real scenes alike from one seed") {
    NEED_VULKAN();
    const std::filesystem::path folder = asset_folder();
    if (folder.empty()) {
        SKIP_TEST("no real assets at DIPTYCH_ASSETS or ../shared/assets");
    }
    for (const std::string file :
         {"khronos/BoxTextured/glTF-Binary/BoxTextured.glb", "khronos/AlphaBlendModeTest/AlphaBlendModeTest.glb",
          "khronos/NegativeScaleTest/NegativeScaleTest.glb", "khronos/NormalTangentTest/NormalTangentTest.gltf",
          "khronos/TextureSettingsTest/glTF/TextureSettingsTest.gltf", "khronos/UnlitTest/UnlitTest.gltf",
          "cornell_mm/cornell_mm.gltf"}) {
        Scene scene = load_gltf(folder / file);
        complete_scene(scene);
        check_pair(std::filesystem::path(file).stem(), scene, paired_settings(32, 24, Integrator::path, BrdfModel::ggx),
                   4, 0.995);
    }
}
