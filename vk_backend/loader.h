// The Vulkan loader, opened at run time, and an instance made with it.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "vulkan_headers.h"

namespace diptych {

struct VulkanInstance {
    vk::raii::Context context;
    vk::raii::Instance instance = nullptr;
    std::optional<vk::raii::DebugUtilsMessengerEXT> messenger;
};

/// Opens the loader (the library named by DIPTYCH_VULKAN_LOADER, else the system's) and makes a Vulkan 1.2 instance,
/// with core and synchronisation validation where asked for. Throws NoDevice where there is no loader, no driver or an
/// older Vulkan; Error where the validation layer is missing.
VulkanInstance open_instance(bool validation);

}  // namespace diptych
