// Vulkan-Hpp as this backend uses it: RAII handles, exceptions, no prototypes, and dynamic loading (loader.h).
#pragma once

#define VULKAN_HPP_ENABLE_DYNAMIC_LOADER_TOOL 0
#define VULKAN_HPP_NO_STRUCT_CONSTRUCTORS
#include <vulkan/vulkan_raii.hpp>

#include <string>

#include "error.h"

namespace diptych::core {

/// Runs `work`. A Vulkan call that fails becomes an Error that names the task: DeviceLost if the device is lost,
/// OutOfMemory if memory ran out.
template <typename Work>
auto in_context(const std::string& doing, Work&& work) {
    try {
        return work();
    } catch (const vk::DeviceLostError& error) {
        throw DeviceLost("Vulkan, " + doing + ": the device is lost: " + error.what());
    } catch (const vk::OutOfDeviceMemoryError& error) {
        throw OutOfMemory("Vulkan, " + doing + ": out of memory: " + error.what());
    } catch (const vk::OutOfHostMemoryError& error) {
        throw OutOfMemory("Vulkan, " + doing + ": out of memory: " + error.what());
    } catch (const vk::SystemError& error) {
        throw Error("Vulkan, " + doing + ": " + error.what());
    }
}

}  // namespace diptych::core
