#include "device/gpu.h"

#include <algorithm>
#include <string_view>

#include "device/devices.h"

namespace diptych::core {
namespace {

void require_presentation(const vk::raii::PhysicalDevice& physical, std::uint32_t family) {
    const std::string name = physical.getProperties().deviceName.data();
    const auto extensions = physical.enumerateDeviceExtensionProperties();
    if (std::none_of(extensions.begin(), extensions.end(), [](const auto& extension) {
            return std::string_view(extension.extensionName.data()) == VK_KHR_SWAPCHAIN_EXTENSION_NAME;
        })) {
        throw NoDevice("Vulkan device " + name + " lacks " + VK_KHR_SWAPCHAIN_EXTENSION_NAME +
                       ", so it shows no window");
    }
    if (!(physical.getQueueFamilyProperties()[family].queueFlags & vk::QueueFlagBits::eGraphics)) {
        throw NoDevice("Vulkan device " + name + " lacks a queue that computes and draws, so it shows no window");
    }
}

vk::raii::Device make_device(const vk::raii::PhysicalDevice& physical, std::uint32_t family, bool presents) {
    const float priority = 1.0F;
    const vk::DeviceQueueCreateInfo queue{.queueFamilyIndex = family, .queueCount = 1, .pQueuePriorities = &priority};
    vk::PhysicalDeviceRayTracingPipelineFeaturesKHR pipeline{.rayTracingPipeline = VK_TRUE,
                                                             .rayTracingPipelineTraceRaysIndirect = VK_TRUE};
    vk::PhysicalDeviceAccelerationStructureFeaturesKHR structures{.pNext = &pipeline, .accelerationStructure = VK_TRUE};
    vk::PhysicalDeviceVulkan12Features vulkan12;
    vulkan12.pNext = &structures;
    vulkan12.bufferDeviceAddress = VK_TRUE;
    vulkan12.scalarBlockLayout = VK_TRUE;
    vk::DeviceCreateInfo info{.pNext = &vulkan12, .queueCreateInfoCount = 1, .pQueueCreateInfos = &queue};
    std::vector<const char*> extensions = required_extensions();
    if (presents) {
        require_presentation(physical, family);
        extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    }
    info.setPEnabledExtensionNames(extensions);
    return physical.createDevice(info);
}

}  // namespace

std::shared_ptr<Gpu> open_gpu(const GpuRequest& request) {
    const std::shared_ptr<Gpu> opened(new Gpu{.vulkan = open_instance(request.validation, request.instance_extensions),
                                              .name = {},
                                              .memory = {},
                                              .ray_tracing = {},
                                              .queue_mutex = {},
                                              .pipelines_mutex = {}});
    Gpu& gpu = *opened;
    in_context("opening the device", [&] {
        gpu.physical = choose_device(gpu.vulkan.instance, request.device);
        gpu.queue_family = static_cast<std::uint32_t>(compute_queue_family(gpu.physical));
        gpu.device = make_device(gpu.physical, gpu.queue_family, request.presents);
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
    });
    return opened;
}

void submit(const Gpu& gpu, const vk::SubmitInfo& info, vk::Fence fence) {
    const std::lock_guard lock(gpu.queue_mutex);
    gpu.queue.submit(info, fence);
}

void wait_idle(const Gpu& gpu) {
    const std::lock_guard lock(gpu.queue_mutex);
    in_context("waiting for the device", [&] { gpu.device.waitIdle(); });
}

}  // namespace diptych::core
