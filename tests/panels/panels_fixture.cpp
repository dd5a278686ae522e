#include "panels_fixture.h"

#include <cstdlib>

#include "scene/own_light.h"

namespace diptych::core::tests {

std::shared_ptr<Gpu> panels_gpu() {
    static const std::shared_ptr<Gpu> gpu = open_device({});
    return gpu;
}

Film render_vulkan(const PackedScene& packed, std::uint32_t spp) {
    static const std::shared_ptr<Gpu> gpu = open_device({.device = "", .validation = has_validation_layer()});
    Film film;
    {
        const auto renderer = make_vulkan_renderer(gpu, packed);
        const std::atomic<bool> cancel{false};
        renderer->render(0, spp, cancel);
        film = renderer->film();
    }
    check_no_validation_messages();
    return film;
}

Film render_vulkan(const Scene& scene, const RenderSettings& settings, std::uint32_t spp) {
    return render_vulkan(pack_scene(scene, settings), spp);
}

void complete_scene(Scene& scene) {
    if (own_light(scene) != OwnLight::enough) {
        scene.environment = neutral_sky();
    }
    if (scene.cameras.empty()) {
        scene.cameras.push_back(frame_scene(scene));
    }
}

std::filesystem::path asset_folder() {
    const char* given = std::getenv("DIPTYCH_ASSETS");
    const std::filesystem::path folder = given != nullptr
                                             ? std::filesystem::path(given)
                                             : std::filesystem::path(DIPTYCH_SOURCE_DIR) / "../shared/assets";
    return std::filesystem::is_directory(folder / "gltf") ? folder / "gltf" : std::filesystem::path();
}

RenderSettings paired_settings(int width, int height, Integrator integrator, BrdfModel brdf) {
    RenderSettings s;
    s.width = width;
    s.height = height;
    s.integrator = integrator;
    s.brdf = brdf;
    s.seed = 21;
    s.max_depth = 5;
    return s;
}

double fraction_equal(const Film& a, const Film& b) {
    return compare_images(develop(a), develop(b)).fraction_equal;
}

}  // namespace diptych::core::tests
