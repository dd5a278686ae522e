// The device that renders: its queue and its limits. Renderers and the display pass share one Gpu.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "device/faults.h"
#include "device/loader.h"
#include "device/vulkan_headers.h"

namespace diptych::core {

struct GpuRequest {
    std::string device = {};                            // "" the best, else an index or a part of the name (devices.h)
    bool validation = false;                            // core and synchronisation validation
    std::vector<std::string> instance_extensions = {};  // needed by a window's surface
    bool presents = false;                              // VK_KHR_swapchain, and a queue that draws
};

struct PipelineStore;  // pipelines/pipeline_store.h

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
    std::uint32_t most_workgroups = 65535;  // of a dispatch in one dimension
    double tick_seconds = 0;              // of a timestamp; 0 if the queue has none
    std::uint64_t tick_mask = 0;          // valid bits of a timestamp
    mutable std::mutex queue_mutex;       // held during submit, present and waiting for the queue
    mutable std::mutex pipelines_mutex;   // held while the store of pipelines is read or written
    mutable std::shared_ptr<PipelineStore> pipelines = {};  // compiled on this device
    bool on_cpu = false;                  // the driver renders on the CPU, in the machine's own memory
    bool has_memory_budget = false;       // VK_EXT_memory_budget
    std::uint64_t largest_allocation = 0;
    std::uint64_t largest_buffer = 0;
    std::shared_ptr<MemoryUse> memory_use = std::make_shared<MemoryUse>();
    mutable std::atomic<bool> lost = false;  // nothing that is submitted to it runs any more
    mutable Faults faults = {};              // set by tests before the device is used
};

/// Opens the chosen device. Throws NoDevice or Error.
std::shared_ptr<Gpu> open_gpu(const GpuRequest& request);

/// Submits; may be called from any thread. Throws vk::SystemError.
void submit(const Gpu& gpu, const vk::SubmitInfo& info, vk::Fence fence);

/// Waits for the submission with this fence. Throws vk::SystemError.
void wait_for(const Gpu& gpu, vk::Fence fence);

/// Waits for all submissions of all threads. Throws DeviceLost or another Error.
void wait_idle(const Gpu& gpu);

}  // namespace diptych::core
