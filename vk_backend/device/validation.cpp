#include "device/validation.h"

#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <string_view>

#include "device/vulkan_headers.h"

namespace diptych::core {
namespace {

constexpr std::size_t kept_messages = 100;

struct Log {
    std::mutex mutex;
    std::vector<std::string> messages;
    std::uint64_t count = 0;
};

Log& log() {
    static Log instance;
    return instance;
}

VKAPI_ATTR VkBool32 VKAPI_CALL collect(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                       const VkDebugUtilsMessengerCallbackDataEXT* data, void*) {
    const std::lock_guard lock(log().mutex);
    ++log().count;
    if (log().messages.size() < kept_messages) {
        const std::string id = data->pMessageIdName != nullptr ? data->pMessageIdName : "";
        log().messages.push_back(id + ": " + data->pMessage);
        std::fprintf(stderr, "validation: %s\n", log().messages.back().c_str());
    }
    return VK_FALSE;
}

}  // namespace

std::vector<std::string> validation_messages() {
    const std::lock_guard lock(log().mutex);
    return log().messages;
}

std::uint64_t validation_message_count() {
    const std::lock_guard lock(log().mutex);
    return log().count;
}

void clear_validation_messages() {
    const std::lock_guard lock(log().mutex);
    log().messages.clear();
    log().count = 0;
}

bool validation_wanted(bool option) {
    const char* variable = std::getenv("DIPTYCH_VALIDATION");
    return option || (variable != nullptr && std::string_view(variable) == "1");
}

vk::DebugUtilsMessengerCreateInfoEXT validation_messenger() {
    // The C structure, because Vulkan-Hpp has changed the type of its callback between releases.
    VkDebugUtilsMessengerCreateInfoEXT info = vk::DebugUtilsMessengerCreateInfoEXT();
    info.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT;
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    info.pfnUserCallback = &collect;
    vk::DebugUtilsMessengerCreateInfoEXT messenger;
    messenger = info;
    return messenger;
}

}  // namespace diptych::core
