// Every real asset that loads, on both panels: from one seed pixel by pixel, from two seeds by the image's mean.
#include <algorithm>
#include <cstdio>

#include "error.h"
#include "panels_fixture.h"

using namespace diptych;
using namespace diptych::tests;

namespace {

std::vector<std::filesystem::path> asset_files() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(asset_folder())) {
        const std::filesystem::path extension = entry.path().extension();
        if (entry.is_regular_file() && (extension == ".gltf" || extension == ".glb")) {
            files.push_back(entry.path());
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace

TEST_CASE("Both panels paint every real scene alike, from one seed and from two", "[nightly]") {
    NEED_VULKAN();
    if (asset_folder().empty()) {
        SKIP_TEST("no real assets at DIPTYCH_ASSETS or ../shared/assets");
    }
    int painted = 0;
    for (const std::filesystem::path& file : asset_files()) {
        const std::string name = std::filesystem::relative(file, asset_folder()).string();
        Scene scene;
        try {
            scene = load_gltf(file, {{"AMD_split_roughnessMetallic"}});  // Sponza requires it, and uses it nowhere
        } catch (const Error& error) {
            std::printf("| %s | refused: %s |\n", name.c_str(), error.what());
            continue;
        }
        complete_scene(scene);
        INFO(name);

        const RenderSettings paired = paired_settings(24, 18, Integrator::path, BrdfModel::ggx);
        const Film cpu = render_cpu(scene, paired, 4);
        const Film vulkan = render_vulkan(scene, paired, 4);
        const double equal = fraction_equal(cpu, vulkan);
        const PairedDifference difference = paired_difference(cpu, vulkan);

        RenderSettings settings = statistical_settings(24, 18, Integrator::path, 5);
        const ImageMean cpu_mean = image_mean(render_cpu(scene, settings, 64));
        settings.seed = 9001;
        const ImageMean vulkan_mean = image_mean(render_vulkan(scene, settings, 64));
        const double z = worst_z(cpu_mean, vulkan_mean);

        std::printf("| %s | %.4f | %.2f | %.2f | %.2f %% |\n", name.c_str(), equal, difference.z, z,
                    100 * relative_error(cpu_mean, vulkan_mean));
        std::fflush(stdout);
        // Lavapipe: 0.947 on the two Bistro scenes, lit by thousands of tiny triangles, whose solid angles round most.
        CHECK(equal >= 0.93);
        CHECK(difference.z < 4.5);
        CHECK(film_totals(cpu).nonfinite == 0);
        CHECK(film_totals(vulkan).nonfinite == 0);
        CHECK(film_totals(vulkan).samples == film_totals(cpu).samples);
        INFO("cpu " << describe(cpu_mean) << "vulkan " << describe(vulkan_mean));
        CHECK(z < 4);
        CHECK(cpu_mean.nonfinite + vulkan_mean.nonfinite == 0);
        ++painted;
    }
    CHECK(painted > 20);
}
