#include "vulkan_device.h"

#include "device/devices.h"
#include "error.h"
#include "device/gpu.h"
#include "skipping.h"
#include "device/validation.h"

namespace diptych::core::tests {

bool has_vulkan() {
    for (const VulkanDeviceInfo& info : list_vulkan_devices()) {
        if (info.usable) {
            return true;
        }
    }
    return false;
}

bool has_validation_layer() {
    static const bool present = [] {
        try {
            open_instance(true);
            return true;
        } catch (const Error&) {
            return false;
        }
    }();
    return present;
}

void check_no_validation_messages() {
    if (!has_validation_layer()) {
        report_left_out("what the Vulkan validation layer would say: it is not installed (package "
                        "vulkan-validationlayers)");
        return;
    }
    for (const std::string& message : validation_messages()) {
        INFO(message);
        CHECK(false);
    }
    CHECK(validation_message_count() == 0);
    clear_validation_messages();
}

}  // namespace diptych::core::tests
