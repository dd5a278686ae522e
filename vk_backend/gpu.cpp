#include "gpu.h"

#include "devices.h"

namespace diptych {
namespace {

vk::raii::Device make_device(const vk::raii::PhysicalDevice& physical, std::uint32_t family) {
    const float priority = 1.0F;
    const vk::DeviceQueueCreateInfo queue{.queueFamilyIndex = family, .queueCount = 1, .pQueuePriorities = &priority};
    vk::PhysicalDeviceRayTracingPipelineFeaturesKHR pipeline{.rayTracingPipeline = VK_TRUE};
    vk::PhysicalDeviceAccelerationStructureFeaturesKHR structures{.pNext = &pipeline, .accelerationStructure = VK_TRUE};
    vk::PhysicalDeviceVulkan12Features vulkan12;
    vulkan12.pNext = &structures;
    vulkan12.bufferDeviceAddress = VK_TRUE;
    vulkan12.scalarBlockLayout = VK_TRUE;
    vk::DeviceCreateInfo info{.pNext = &vulkan12, .queueCreateInfoCount = 1, .pQueueCreateInfos = &queue};
    info.setPEnabledExtensionNames(required_extensions());
    return physical.createDevice(info);
}

}  // namespace

Gpu open_gpu(const std::string& choice, bool validation) {
    Gpu gpu{.vulkan = open_instance(validation), .name = {}, .memory = {}, .ray_tracing = {}};
    return in_context("opening the device", [&] {
        gpu.physical = choose_device(gpu.vulkan.instance, choice);
        gpu.queue_family = static_cast<std::uint32_t>(compute_queue_family(gpu.physical));
        gpu.device = make_device(gpu.physical, gpu.queue_family);
        gpu.queue = gpu.device.getQueue(gpu.queue_family, 0);
        gpu.memory = gpu.physical.getMemoryProperties();
        const auto properties =
            gpu.physical
                .getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceRayTracingPipelinePropertiesKHR,
                                vk::PhysicalDeviceAccelerationStructurePropertiesKHR>();
        const vk::PhysicalDeviceProperties& core = properties.get<vk::PhysicalDeviceProperties2>().properties;
        gpu.name = core.deviceName.data();
        gpu.ray_tracing = properties.get<vk::PhysicalDeviceRayTracingPipelinePropertiesKHR>();
        gpu.ray_tracing.pNext = nullptr;
        gpu.scratch_alignment = properties.get<vk::PhysicalDeviceAccelerationStructurePropertiesKHR>()
                                    .minAccelerationStructureScratchOffsetAlignment;
        const std::uint32_t bits = gpu.physical.getQueueFamilyProperties()[gpu.queue_family].timestampValidBits;
        if (bits > 0) {
            gpu.tick_seconds = static_cast<double>(core.limits.timestampPeriod) * 1e-9;
            gpu.tick_mask = bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
        }
        return std::move(gpu);
    });
}

}  // namespace diptych
