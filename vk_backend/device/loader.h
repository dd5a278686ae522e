// The Vulkan loader, opened at run time, and an instance made with it.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "device/vulkan_headers.h"

namespace diptych::core {

struct VulkanInstance {
    vk::raii::Context context;
    vk::raii::Instance instance = nullptr;
    std::optional<vk::raii::DebugUtilsMessengerEXT> messenger;
};

/// Opens the loader (the library named by DIPTYCH_VULKAN_LOADER, else the system's) and makes a Vulkan 1.2 instance,
/// with core and synchronisation validation where asked for, and with the extensions named. Throws NoDevice where there
/// is no loader, no driver, an older Vulkan or no such extension; Error where the validation layer is missing.
VulkanInstance open_instance(bool validation, std::span<const std::string> extensions = {});

}  // namespace diptych::core
