// Opens the Vulkan loader at run time and creates an instance.
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

/// Opens the loader (the library named by DIPTYCH_VULKAN_LOADER, else the system's) and creates a Vulkan 1.2 instance
/// with the given extensions and, if `validation`, with core and synchronisation validation. Throws NoDevice if there
/// is no loader or driver, if Vulkan is too old or an extension is missing; Error if the validation layer is missing.
VulkanInstance open_instance(bool validation, std::span<const std::string> extensions = {});

}  // namespace diptych::core
