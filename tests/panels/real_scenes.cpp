// Every real asset that loads, on both panels: from one seed pixel by pixel, from two seeds by the image's mean.
#include <algorithm>
#include <cstdio>

#include "error.h"
#include "panels_fixture.h"

using namespace diptych::core;
using namespace diptych::core::tests;

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

/// Normal and roughness maps turn the rounding of where they are looked up into other directions, which every further
/// bounce magnifies: Sponza has 0.85 of its pixels equal with them, 0.99 without; Bistro's interior, where all light
/// comes off tiny triangles, 0.94 and 0.96.
Scene without_fine_maps(Scene scene) {
    for (Material& material : scene.materials) {
        material.normal_texture.texture = none;
        material.metallic_roughness_texture.texture = none;
    }
    return scene;
}

double image_mean_of(const Film& film) {
    double sum = 0;
    for (const shared::FilmPixel& pixel : film.pixels) {
        const Rgb mean = pixel_mean(pixel);
        sum += mean[0] + mean[1] + mean[2];
    }
    return sum / (3 * static_cast<double>(film.pixels.size()));
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
        Film cpu = render_cpu(scene, paired, 4);
        if (image_mean_of(cpu) == 0) {  // lights of its own that do not show: a black picture would prove nothing
            scene.environment = neutral_sky();
            cpu = render_cpu(scene, paired, 4);
        }
        CHECK(image_mean_of(cpu) > 0);
        const Film vulkan = render_vulkan(scene, paired, 4);
        const double equal = fraction_equal(cpu, vulkan);
        const PairedDifference difference = paired_difference(cpu, vulkan);
        RenderSettings first_bounce = paired;
        first_bounce.max_depth = 1;
        const double equal_first =
            fraction_equal(render_cpu(scene, first_bounce, 4), render_vulkan(scene, first_bounce, 4));
        const Scene smooth = without_fine_maps(scene);
        const double equal_smooth = fraction_equal(render_cpu(smooth, paired, 4), render_vulkan(smooth, paired, 4));

        RenderSettings settings = statistical_settings(24, 18, Integrator::path, 5);
        const ImageMean cpu_mean = image_mean(render_cpu(scene, settings, 64));
        settings.seed = 9001;
        const ImageMean vulkan_mean = image_mean(render_vulkan(scene, settings, 64));
        const double z = worst_z(cpu_mean, vulkan_mean);

        std::printf("| %s | %.4f | %.4f | %.4f | %.2f | %.2f | %.2f %% |\n", name.c_str(), equal, equal_first,
                    equal_smooth, difference.z, z, 100 * relative_error(cpu_mean, vulkan_mean));
        std::fflush(stdout);
        CHECK(equal_first >= 0.99);
        CHECK(equal_smooth >= 0.95);
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
