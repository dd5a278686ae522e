#include "backends/backends.h"

#include <algorithm>

#include "backend/cpu_renderer.h"
#include "error.h"
#include "oracle_renderer/oracle_renderer.h"
#include "threads.h"
#if DIPTYCH_VULKAN
#include <mutex>

#include "device/devices.h"
#include "renderer/vulkan_renderer.h"
#endif

namespace diptych::core::app {

#if DIPTYCH_VULKAN
namespace {

/// The device from its first renderer to the end of the run: opening takes up to a second, and some drivers open a
/// device only some sixty times in a process.
struct KeptDevice {
    std::mutex mutex;
    std::string name;
    bool validation = false;
    std::shared_ptr<Gpu> gpu;
};

KeptDevice& kept_device() {
    static KeptDevice device;
    return device;
}

std::shared_ptr<Gpu> keep_device(const VulkanOptions& options) {
    KeptDevice& kept = kept_device();
    const std::lock_guard lock(kept.mutex);
    const bool other = kept.name != options.device || kept.validation != options.validation;
    if (kept.gpu == nullptr || is_lost(*kept.gpu) || other) {
        kept.gpu.reset();
        kept.gpu = open_device(options);
        kept.name = options.device;
        kept.validation = options.validation;
    }
    return kept.gpu;
}

}  // namespace
#endif

std::vector<std::string> backend_names() {
    return {"cpu", "vulkan", "oracle"};
}

std::unique_ptr<Renderer> open_renderer(const Scene& scene, const PackedScene& packed, const RenderRequest& request,
                                        [[maybe_unused]] const BusyHook& busy) {
    // This thread works too.
    require_threads(request.threads > 0 ? static_cast<unsigned>(request.threads) - 1 : machine_threads() - 1);
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
    options.busy = busy;
    return make_vulkan_renderer(keep_device(options), packed, options);
#else
    throw Error("backend vulkan: this build has no Vulkan (DIPTYCH_VULKAN=OFF); use the backend cpu");
#endif
}

MakeRenderer renderer_maker(const RenderRequest& request) {
    return [request](const Scene& scene, const PackedScene& packed, const RenderSettings& settings) {
        RenderRequest asked = request;
        asked.settings = settings;
        return open_renderer(scene, packed, asked);
    };
}

std::vector<std::string> usable_devices() {
    std::vector<std::string> names;
#if DIPTYCH_VULKAN
    for (const VulkanDeviceInfo& device : list_vulkan_devices()) {
        if (device.usable) {
            names.push_back(device.name);
        }
    }
#endif
    return names;
}

std::string device_in_turn([[maybe_unused]] int local_rank) {
    std::vector<std::size_t> devices;
#if DIPTYCH_VULKAN
    const std::vector<VulkanDeviceInfo> infos = list_vulkan_devices();
    if (std::none_of(infos.begin(), infos.end(), [](const VulkanDeviceInfo& info) { return info.usable; })) {
        return "";
    }
    const std::string& type = infos[choose_device_index(infos, "")].type;
    for (std::size_t i = 0; i < infos.size(); ++i) {
        if (infos[i].usable && infos[i].type == type) {
            devices.push_back(i);
        }
    }
#endif
    return devices.empty() ? "" : std::to_string(devices[static_cast<std::size_t>(local_rank) % devices.size()]);
}

std::uint64_t close_devices() {
#if DIPTYCH_VULKAN
    const std::lock_guard lock(kept_device().mutex);
    kept_device().gpu.reset();  // whose end the layer watches too
    return validation_message_count();
#else
    return 0;
#endif
}

}  // namespace diptych::core::app
