// The machine's Vulkan devices and what they lack.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace vk::raii {
class Instance;
class PhysicalDevice;
}  // namespace vk::raii

namespace diptych::core {

struct VulkanDeviceInfo {
    std::string name;
    std::string type;    // "discrete", "integrated", "virtual", "cpu", "other"
    std::string driver;  // its name and version
    std::uint32_t api_version = 0;
    bool usable = false;
    std::vector<std::string> lacks;  // empty where usable
    std::uint64_t memory = 0;        // bytes, device-local
};

/// In Vulkan's order. Empty where there is no loader, driver or device.
std::vector<VulkanDeviceInfo> list_vulkan_devices();

VulkanDeviceInfo describe_device(const vk::raii::PhysicalDevice& device);

/// A family with compute, preferably with graphics too, since that one is the main one everywhere; -1 where there is
/// none.
int compute_queue_family(const vk::raii::PhysicalDevice& device);

/// Picks by "" (the best usable), an index or a part of the name, case ignored. Throws NoDevice that says what is
/// missing.
std::size_t choose_device_index(const std::vector<VulkanDeviceInfo>& infos, const std::string& choice);

/// The same among an instance's devices.
vk::raii::PhysicalDevice choose_device(const vk::raii::Instance& instance, const std::string& choice);

/// Extensions that a usable device has and that are enabled on it.
const std::vector<const char*>& required_extensions();

}  // namespace diptych::core
