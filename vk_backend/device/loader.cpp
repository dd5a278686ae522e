#include "device/loader.h"

#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "device/validation.h"

namespace diptych::core {
namespace {

constexpr const char* layer_name = "VK_LAYER_KHRONOS_validation";

// The library is never closed, because drivers leave threads and exit handlers behind.
PFN_vkGetInstanceProcAddr open_loader() {
    const char* chosen = std::getenv("DIPTYCH_VULKAN_LOADER");
    std::vector<std::string> names = {"libvulkan.so.1", "libvulkan.so"};
    if (chosen != nullptr && *chosen != '\0') {
        names = {chosen};
    }
    for (const std::string& name : names) {
        if (void* library = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL)) {
            if (void* entry = dlsym(library, "vkGetInstanceProcAddr")) {
                return reinterpret_cast<PFN_vkGetInstanceProcAddr>(entry);
            }
        }
    }
    throw NoDevice("no Vulkan loader: " + names.front() +
                   " cannot be opened; install the package libvulkan1 and a driver, such as "
                   "the graphics card's or mesa-vulkan-drivers 24.3 or later");
}

bool has_layer(const vk::raii::Context& context) {
    const auto layers = context.enumerateInstanceLayerProperties();
    return std::any_of(layers.begin(), layers.end(),
                       [](const auto& layer) { return std::strcmp(layer.layerName, layer_name) == 0; });
}

vk::raii::Instance make_instance(const vk::raii::Context& context, bool validation,
                                 std::span<const std::string> wanted) {
    const vk::ApplicationInfo application{.pApplicationName = "diptych", .apiVersion = VK_API_VERSION_1_2};
    vk::InstanceCreateInfo info{.pApplicationInfo = &application};
    std::vector<const char*> extensions;
    for (const std::string& name : wanted) {
        extensions.push_back(name.c_str());
    }
    constexpr std::array enabled = {vk::ValidationFeatureEnableEXT::eSynchronizationValidation};
    vk::DebugUtilsMessengerCreateInfoEXT messenger = validation_messenger();
    vk::ValidationFeaturesEXT features;
    if (validation) {
        if (!has_layer(context)) {
            throw Error(std::string("Vulkan validation was asked for, but ") + layer_name +
                        " is not installed (package vulkan-validationlayers)");
        }
        features.setEnabledValidationFeatures(enabled).setPNext(&messenger);
        info.setPNext(&features);
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
        extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &layer_name;
    }
    info.setPEnabledExtensionNames(extensions);
    return context.createInstance(info);
}

}  // namespace

VulkanInstance open_instance(bool validation, std::span<const std::string> extensions) {
    VulkanInstance opened{.context = vk::raii::Context(open_loader()), .instance = nullptr, .messenger = {}};
    try {
        if (opened.context.enumerateInstanceVersion() < VK_API_VERSION_1_2) {
            throw NoDevice("the Vulkan loader is older than 1.2");
        }
        opened.instance = make_instance(opened.context, validation, extensions);
        if (validation) {
            opened.messenger = opened.instance.createDebugUtilsMessengerEXT(validation_messenger());
        }
    } catch (const vk::IncompatibleDriverError&) {
        throw NoDevice("no Vulkan driver: install the graphics card's, or mesa-vulkan-drivers 24.3 or later, which "
                       "renders on the CPU");
    } catch (const vk::SystemError& error) {
        throw NoDevice(std::string("no Vulkan instance: ") + error.what());
    }
    return opened;
}

}  // namespace diptych::core
