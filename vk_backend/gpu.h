// The device that is rendered on: its queue and the limits that matter here.
#pragma once

#include <cstdint>
#include <string>

#include "loader.h"
#include "vulkan_headers.h"

namespace diptych {

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
};

/// Opens the chosen device (devices.h). Throws NoDevice or Error.
Gpu open_gpu(const std::string& choice, bool validation);

}  // namespace diptych
