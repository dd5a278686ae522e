// The machine's Vulkan devices, and the features that each of them lacks.
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

/// In Vulkan's order. Empty if there is no loader, driver or device.
std::vector<VulkanDeviceInfo> list_vulkan_devices();

VulkanDeviceInfo describe_device(const vk::raii::PhysicalDevice& device);

/// Index of a queue family with compute, preferably with graphics too, because that is the main family on all devices;
/// -1 if there is none.
int compute_queue_family(const vk::raii::PhysicalDevice& device);

/// Chooses a device by index or by a part of its name, ignoring case; "" chooses the best usable device. Throws
/// NoDevice, which says what is missing.
std::size_t choose_device_index(const std::vector<VulkanDeviceInfo>& infos, const std::string& choice);

/// The same among an instance's devices.
vk::raii::PhysicalDevice choose_device(const vk::raii::Instance& instance, const std::string& choice);

/// Device extensions that a usable device supports. All of them are enabled.
const std::vector<const char*>& required_extensions();

}  // namespace diptych::core
