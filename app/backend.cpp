#include "backend.h"

#include "backend/cpu_renderer.h"
#include "error.h"
#if DIPTYCH_VULKAN
#include "vulkan_renderer.h"
#endif

namespace diptych::app {

std::unique_ptr<Renderer> make_renderer(const PackedScene& packed, const RenderRequest& request) {
    if (request.backend == "cpu") {
        return make_cpu_renderer(packed, request.threads);
    }
#if DIPTYCH_VULKAN
    VulkanOptions options;
    options.device = request.device;
    options.validation = request.validation;
    return make_vulkan_renderer(packed, options);
#else
    throw Error("--backend vulkan: this program was built without it (DIPTYCH_VULKAN=OFF); use --backend cpu");
#endif
}

}  // namespace diptych::app
