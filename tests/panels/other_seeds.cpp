// With seeds of their own, both panels have one mean.
#include <cstdio>

#include "panels_fixture.h"

using namespace diptych::core;
using namespace diptych::core::tests;

TEST_CASE("Both panels have one image mean from seeds of their own") {
    NEED_VULKAN();
    for (const std::string& name : own_scenes()) {
        const Scene scene = load_own_scene(name);
        for (const Integrator integrator : integrators) {
            RenderSettings settings = statistical_settings(32, 24, integrator, 4);
            const ImageMean cpu = image_mean(render_cpu(scene, settings, 32));
            settings.seed = 9001;
            const ImageMean vulkan = image_mean(render_vulkan(scene, settings, 32));
            const double z = worst_z(cpu, vulkan);
            std::printf("%-14s %-6s z %.2f, relative error %.4f\n", name.c_str(), name_of(integrator), z,
                        relative_error(cpu, vulkan));
            INFO(name << " " << name_of(integrator) << " cpu " << describe(cpu) << "vulkan " << describe(vulkan));
            CHECK(z < 4);
            CHECK(cpu.nonfinite + vulkan.nonfinite == 0);
        }
    }
}
