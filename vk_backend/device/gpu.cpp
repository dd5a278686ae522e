#include "device/gpu.h"

#include <algorithm>
#include <limits>
#include <string_view>

#include "device/devices.h"

namespace diptych::core {
namespace {

bool has_extension(const vk::raii::PhysicalDevice& physical, std::string_view name) {
    const auto extensions = physical.enumerateDeviceExtensionProperties();
    return std::any_of(extensions.begin(), extensions.end(),
                       [&](const auto& extension) { return name == extension.extensionName.data(); });
}

void require_presentation(const vk::raii::PhysicalDevice& physical, std::uint32_t family) {
    const std::string name = physical.getProperties().deviceName.data();
    if (!has_extension(physical, VK_KHR_SWAPCHAIN_EXTENSION_NAME)) {
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

void find_memory_limits(Gpu& gpu) {
    gpu.memory = gpu.physical.getMemoryProperties();
    const vk::PhysicalDeviceProperties properties = gpu.physical.getProperties();
    gpu.on_cpu = properties.deviceType == vk::PhysicalDeviceType::eCpu;
    gpu.most_workgroups = properties.limits.maxComputeWorkGroupCount[0];
    gpu.has_memory_budget = has_extension(gpu.physical, VK_EXT_MEMORY_BUDGET_EXTENSION_NAME);
    gpu.largest_allocation =
        gpu.physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceMaintenance3Properties>()
            .get<vk::PhysicalDeviceMaintenance3Properties>()
            .maxMemoryAllocationSize;
    gpu.largest_buffer = std::numeric_limits<std::uint64_t>::max();
    if (has_extension(gpu.physical, VK_KHR_MAINTENANCE_4_EXTENSION_NAME)) {
        gpu.largest_buffer =
            gpu.physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceMaintenance4PropertiesKHR>()
                .get<vk::PhysicalDeviceMaintenance4PropertiesKHR>()
                .maxBufferSize;
    }
}

/// Runs a call to the queue or the device, and notes that the device is lost if the call says so.
template <typename Call>
void noting_loss(const Gpu& gpu, Call&& call) {
    try {
        call();
    } catch (const vk::DeviceLostError&) {
        gpu.lost = true;
        throw;
    }
}

/// The device comes to rest first, as a lost device does, so that what it used may be destroyed.
[[noreturn]] void lose(const Gpu& gpu) {
    gpu.device.waitIdle();
    throw vk::DeviceLostError("a test");
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
        find_memory_limits(gpu);
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
    noting_loss(gpu, [&] {
        if (gpu.faults.submission && (gpu.lost || gpu.faults.submission())) {
            lose(gpu);
        }
        gpu.queue.submit(info, fence);
    });
}

void wait_for(const Gpu& gpu, vk::Fence fence) {
    noting_loss(gpu, [&] {
        while (gpu.device.waitForFences(fence, VK_TRUE, std::numeric_limits<std::uint64_t>::max()) ==
               vk::Result::eTimeout) {
        }
    });
}

void wait_idle(const Gpu& gpu) {
    const std::lock_guard lock(gpu.queue_mutex);
    in_context("waiting for the device", [&] { noting_loss(gpu, [&] { gpu.device.waitIdle(); }); });
}

}  // namespace diptych::core
