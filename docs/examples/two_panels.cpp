// Renders a scene on both panels, writes the pictures and says how far they differ: two_panels SCENE.glb FOLDER
#include <diptych/diptych.h>

#include <cstdio>
#include <string>

int main(int argc, char** argv) try {
    if (argc != 3) {
        std::fprintf(stderr, "usage: two_panels SCENE FOLDER\n");
        return 2;
    }
    const std::string folder = argv[2];
    const auto print = [](const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); };
    diptych::Scene scene = diptych::load(argv[1], {.warnings = print});
    scene.add(diptych::Sun{.azimuth = 40, .elevation = 30, .irradiance = 2});

    diptych::Settings settings;
    settings.size = {160, 120};
    diptych::Session cpu(scene, {.backend = diptych::Backend::cpu}, settings);
    cpu.render(16);
    const diptych::Film reference = cpu.film();
    reference.save(folder + "/cpu.exr");
    std::printf("cpu: %u samples a pixel, relMSE %.2g\n", reference.info().spp, reference.relmse_estimate());

    if (diptych::devices().empty()) {
        std::printf("vulkan: no device\n");
        return 0;
    }
    settings.seed = 1;  // other random numbers, so that the z of the difference has a meaning
    diptych::Session vulkan(scene, {.backend = diptych::Backend::vulkan}, settings);
    vulkan.render(16);
    vulkan.film().save(folder + "/vulkan.exr");
    const diptych::Comparison difference = diptych::compare(vulkan.film(), reference);
    std::printf("%s: mean ratio %.4f, z %.2f\n", vulkan.device().c_str(), difference.mean_ratio[1], difference.z[1]);
    return 0;
} catch (const diptych::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
}
