#include "commands/info/devices_info.h"

#include <fmt/format.h>

#include <thread>

#if DIPTYCH_EMBREE_VERSION >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "commands/command.h"
#include "error.h"
#include "console/output.h"
#include "console/report.h"
#if DIPTYCH_VULKAN
#include <vulkan/vulkan_core.h>

#include "device/devices.h"
#endif

namespace diptych::core::app {

namespace {

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) {
        text += (text.empty() ? "" : ", ") + word;
    }
    return text;
}

#if DIPTYCH_VULKAN
std::string version_text(std::uint32_t version) {
    return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
                       VK_API_VERSION_PATCH(version));
}
#endif

/// The Vulkan devices; `reason` says why there are none to be had.
nlohmann::ordered_json vulkan_devices(std::string& reason) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
#if DIPTYCH_VULKAN
    try {
        for (const auto& device : list_vulkan_devices()) {
            list.push_back({{"index", list.size()},
                            {"name", device.name},
                            {"type", device.type},
                            {"driver", device.driver},
                            {"api_version", version_text(device.api_version)},
                            {"memory", device.memory},
                            {"usable", device.usable},
                            {"lacks", device.lacks}});
        }
    } catch (const NoDevice& error) {
        reason = error.what();
    }
#else
    reason = "this program was built without Vulkan (DIPTYCH_VULKAN=OFF)";
#endif
    return list;
}

}  // namespace

int print_devices(bool json) {
    std::string reason;
    const unsigned threads = std::thread::hardware_concurrency();
    const nlohmann::ordered_json devices = vulkan_devices(reason);
    if (json) {
        nlohmann::ordered_json all;
        all["cpu"] = {{"threads", threads}, {"embree", RTC_VERSION_STRING}, {"usable", true}};
        all["vulkan"] = devices;
        if (!reason.empty()) {
            all["vulkan_reason"] = reason;
        }
        print_json(all);
        return exit_done;
    }
    print_result("cpu     {} threads, Embree {}\n", threads, RTC_VERSION_STRING);
    for (const auto& device : devices) {
        print_result("vulkan  {} {} ({}, {}, Vulkan {}, {}): ", device["index"].get<int>(),
                     device["name"].get<std::string>(), device["type"].get<std::string>(),
                     device["driver"].get<std::string>(), device["api_version"].get<std::string>(),
                     byte_text(device["memory"].get<double>()));
        const auto lacks = device["lacks"].get<std::vector<std::string>>();
        print_result("{}\n", device["usable"].get<bool>() ? "usable" : "lacks " + joined(lacks));
    }
    if (devices.empty()) {
        print_result("vulkan  no device{}\n", reason.empty() ? "" : ": " + reason);
    }
    return exit_done;
}

}  // namespace diptych::core::app
