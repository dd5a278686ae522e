#include "session/backend.h"

#include <fmt/format.h>

#include "backend/cpu_renderer.h"
#include "console/exit_codes.h"
#include "error.h"
#include "oracle_renderer/oracle_renderer.h"
#include "console/report.h"
#if DIPTYCH_VULKAN
#include "renderer/vulkan_renderer.h"
#endif

namespace diptych::core::app {

namespace {

RendererMaker& replacement() {
    static RendererMaker maker;
    return maker;
}

#if DIPTYCH_VULKAN
/// The device from its first renderer to the end of the run: opening takes up to a second, and some drivers open a
/// device only some sixty times in a process.
struct KeptDevice {
    std::string name;
    bool validation = false;
    std::shared_ptr<Gpu> gpu;
};

KeptDevice& kept_device() {
    static KeptDevice device;
    return device;
}

const std::shared_ptr<Gpu>& keep_device(const VulkanOptions& options) {
    KeptDevice& kept = kept_device();
    if (kept.gpu == nullptr || kept.name != options.device || kept.validation != options.validation) {
        kept.gpu.reset();
        kept = {options.device, options.validation, open_device(options)};
    }
    return kept.gpu;
}
#endif

}  // namespace

void replace_renderers(RendererMaker maker) {
    replacement() = std::move(maker);
}

std::vector<std::string> backend_names() {
    return {"cpu", "vulkan", "oracle"};
}

std::unique_ptr<Renderer> make_renderer(const Scene& scene, const PackedScene& packed, const RenderRequest& request) {
    if (replacement()) {
        return replacement()(scene, packed, request);
    }
    if (request.backend == "oracle") {
        return make_oracle_renderer(scene, request.settings, oracle_mode_from_name(request.oracle_mode),
                                    request.threads);
    }
    if (request.backend == "cpu") {
        return make_cpu_renderer(packed, request.threads);
    }
#if DIPTYCH_VULKAN
    VulkanOptions options;
    options.device = request.device;
    options.validation = request.validation;
    options.group_instances = request.group_instances;
    return make_vulkan_renderer(keep_device(options), packed, options);
#else
    throw Error("--backend vulkan: this program was built without it (DIPTYCH_VULKAN=OFF); use --backend cpu");
#endif
}

int exit_code_after_validation(int exit_code) {
#if DIPTYCH_VULKAN
    kept_device().gpu.reset();  // whose end the layer watches too
    if (const std::uint64_t count = validation_message_count(); count > 0) {
        report_error(fmt::format("validation: the layer had {} message{}", count, count == 1 ? "" : "s"));
        return exit_code == exit_done ? exit_check_failed : exit_code;
    }
#endif
    return exit_code;
}

}  // namespace diptych::core::app
