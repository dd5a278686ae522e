#include "device/devices.h"

#include <algorithm>
#include <cctype>
#include <charconv>

#include "device/loader.h"

namespace diptych::core {
namespace {

std::string type_name(vk::PhysicalDeviceType type) {
    switch (type) {
    case vk::PhysicalDeviceType::eDiscreteGpu:
        return "discrete";
    case vk::PhysicalDeviceType::eIntegratedGpu:
        return "integrated";
    case vk::PhysicalDeviceType::eVirtualGpu:
        return "virtual";
    case vk::PhysicalDeviceType::eCpu:
        return "cpu";
    default:
        return "other";
    }
}

int type_rank(const std::string& type) {
    return type == "discrete" ? 4 : type == "integrated" ? 3 : type == "virtual" ? 2 : type == "cpu" ? 1 : 0;
}

std::string version_text(std::uint32_t version) {
    return std::to_string(VK_API_VERSION_MAJOR(version)) + "." + std::to_string(VK_API_VERSION_MINOR(version));
}

void note_missing_features(const vk::raii::PhysicalDevice& device, std::vector<std::string>& lacks) {
    const auto chain = device.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan12Features,
                                           vk::PhysicalDeviceAccelerationStructureFeaturesKHR,
                                           vk::PhysicalDeviceRayTracingPipelineFeaturesKHR>();
    const auto& vulkan12 = chain.get<vk::PhysicalDeviceVulkan12Features>();
    const auto note = [&](vk::Bool32 present, const char* name) {
        if (present == VK_FALSE) {
            lacks.push_back(std::string("feature ") + name);
        }
    };
    note(vulkan12.bufferDeviceAddress, "bufferDeviceAddress");
    note(vulkan12.scalarBlockLayout, "scalarBlockLayout");
    note(chain.get<vk::PhysicalDeviceAccelerationStructureFeaturesKHR>().accelerationStructure,
         "accelerationStructure");
    const auto& pipeline = chain.get<vk::PhysicalDeviceRayTracingPipelineFeaturesKHR>();
    note(pipeline.rayTracingPipeline, "rayTracingPipeline");
    note(pipeline.rayTracingPipelineTraceRaysIndirect, "rayTracingPipelineTraceRaysIndirect");
}

std::vector<std::string> find_lacks(const vk::raii::PhysicalDevice& device) {
    std::vector<std::string> lacks;
    if (device.getProperties().apiVersion < VK_API_VERSION_1_2) {
        lacks.push_back("Vulkan 1.2");
        return lacks;
    }
    const auto extensions = device.enumerateDeviceExtensionProperties();
    for (const std::string name : required_extensions()) {
        if (std::none_of(extensions.begin(), extensions.end(),
                         [&](const auto& extension) { return name == extension.extensionName.data(); })) {
            lacks.push_back(name);
        }
    }
    if (lacks.empty()) {
        note_missing_features(device, lacks);
    }
    if (compute_queue_family(device) < 0) {
        lacks.push_back("a compute queue");
    }
    return lacks;
}

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

std::string refusal(const VulkanDeviceInfo& info) {
    std::string text = info.name + " lacks ";
    for (std::size_t i = 0; i < info.lacks.size(); ++i) {
        text += (i > 0 ? ", " : "") + info.lacks[i];
    }
    return text;
}

int find_named(const std::vector<VulkanDeviceInfo>& infos, const std::string& choice) {
    int index = -1;
    const auto [end, error] = std::from_chars(choice.data(), choice.data() + choice.size(), index);
    if (error == std::errc() && end == choice.data() + choice.size()) {
        return index >= 0 && index < static_cast<int>(infos.size()) ? index : -1;
    }
    const auto found = std::find_if(infos.begin(), infos.end(), [&](const VulkanDeviceInfo& info) {
        return lower(info.name).find(lower(choice)) != std::string::npos;
    });
    return found == infos.end() ? -1 : static_cast<int>(found - infos.begin());
}

int find_best(const std::vector<VulkanDeviceInfo>& infos) {
    int best = -1;
    for (int i = 0; i < static_cast<int>(infos.size()); ++i) {
        const VulkanDeviceInfo& info = infos[static_cast<std::size_t>(i)];
        if (info.usable && (best < 0 || type_rank(info.type) > type_rank(infos[static_cast<std::size_t>(best)].type))) {
            best = i;
        }
    }
    return best;
}

}  // namespace

const std::vector<const char*>& required_extensions() {
    static const std::vector<const char*> names = {VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
                                                   VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME,
                                                   VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME};
    return names;
}

int compute_queue_family(const vk::raii::PhysicalDevice& device) {
    const auto families = device.getQueueFamilyProperties();
    int found = -1;
    for (int i = 0; i < static_cast<int>(families.size()); ++i) {
        const vk::QueueFlags flags = families[static_cast<std::size_t>(i)].queueFlags;
        if (flags & vk::QueueFlagBits::eCompute) {
            if (flags & vk::QueueFlagBits::eGraphics) {
                return i;
            }
            found = found < 0 ? i : found;
        }
    }
    return found;
}

VulkanDeviceInfo describe_device(const vk::raii::PhysicalDevice& device) {
    const vk::PhysicalDeviceProperties properties = device.getProperties();
    VulkanDeviceInfo info;
    info.name = properties.deviceName.data();
    info.type = type_name(properties.deviceType);
    info.api_version = properties.apiVersion;
    info.driver = "Vulkan " + version_text(properties.apiVersion);
    if (properties.apiVersion >= VK_API_VERSION_1_2) {
        const auto driver = device.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>()
                                .get<vk::PhysicalDeviceDriverProperties>();
        info.driver = std::string(driver.driverName.data()) + " " + driver.driverInfo.data();
    }
    const vk::PhysicalDeviceMemoryProperties memory = device.getMemoryProperties();
    for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i) {
        if (memory.memoryHeaps[i].flags & vk::MemoryHeapFlagBits::eDeviceLocal) {
            info.memory += memory.memoryHeaps[i].size;
        }
    }
    info.lacks = find_lacks(device);
    info.usable = info.lacks.empty();
    return info;
}

std::vector<VulkanDeviceInfo> list_vulkan_devices() {
    try {
        const VulkanInstance opened = open_instance(false);
        std::vector<VulkanDeviceInfo> infos;
        for (const vk::raii::PhysicalDevice& device : opened.instance.enumeratePhysicalDevices()) {
            infos.push_back(describe_device(device));
        }
        return infos;
    } catch (const NoDevice&) {
        return {};
    } catch (const vk::SystemError&) {
        return {};
    }
}

std::size_t choose_device_index(const std::vector<VulkanDeviceInfo>& infos, const std::string& choice) {
    const int chosen = choice.empty() ? find_best(infos) : find_named(infos, choice);
    if (chosen < 0) {
        std::string text =
            choice.empty() ? "no Vulkan device with ray tracing" : "no Vulkan device matches \"" + choice + "\"";
        for (const VulkanDeviceInfo& info : infos) {
            text += "; " + (info.usable ? "there is " + info.name : refusal(info));
        }
        throw NoDevice(text +
                       (choice.empty() ? "; mesa-vulkan-drivers 24.3 or later has one that runs on the CPU" : ""));
    }
    const VulkanDeviceInfo& info = infos[static_cast<std::size_t>(chosen)];
    if (!info.usable) {
        throw NoDevice("Vulkan device " + refusal(info));
    }
    return static_cast<std::size_t>(chosen);
}

vk::raii::PhysicalDevice choose_device(const vk::raii::Instance& instance, const std::string& choice) {
    const std::vector<vk::raii::PhysicalDevice> devices = instance.enumeratePhysicalDevices();
    std::vector<VulkanDeviceInfo> infos;
    for (const vk::raii::PhysicalDevice& device : devices) {
        infos.push_back(describe_device(device));
    }
    return devices[choose_device_index(infos, choice)];
}

}  // namespace diptych::core
