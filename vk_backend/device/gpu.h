// The device that is rendered on: its queue and the limits that matter here. Renderers and what shows their films share
// one.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "device/loader.h"
#include "device/vulkan_headers.h"

namespace diptych::core {

struct GpuRequest {
    std::string device = {};                            // "" the best, else an index or a part of the name (devices.h)
    bool validation = false;                            // core and synchronisation validation
    std::vector<std::string> instance_extensions = {};  // that a window's surface needs
    bool presents = false;                              // VK_KHR_swapchain, and a queue that draws
};

struct Gpu {
    VulkanInstance vulkan;
    vk::raii::PhysicalDevice physical = nullptr;
    vk::raii::Device device = nullptr;
    vk::raii::Queue queue = nullptr;
    std::uint32_t queue_family = 0;
    std::string name;
    vk::PhysicalDeviceMemoryProperties memory;
    vk::PhysicalDeviceRayTracingPipelinePropertiesKHR ray_tracing;
    std::uint64_t scratch_alignment = 1;  // of acceleration structure builds
    double tick_seconds = 0;              // of timestamps; 0 where the queue has none
    std::uint64_t tick_mask = 0;          // their valid bits
    mutable std::mutex queue_mutex;       // held by whoever submits, presents or waits for the whole queue
};

/// Opens the chosen device. Throws NoDevice or Error.
std::shared_ptr<Gpu> open_gpu(const GpuRequest& request);

/// Submits, from any thread.
void submit(const Gpu& gpu, const vk::SubmitInfo& info, vk::Fence fence);

/// Waits for all that any thread has submitted. Throws DeviceLost or another Error.
void wait_idle(const Gpu& gpu);

}  // namespace diptych::core
