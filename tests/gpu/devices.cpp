// Choosing a device, and machines that have none.
#include "device/devices.h"

#include <cstdlib>
#include <optional>

#include "gpu_fixture.h"
#include "device/loader.h"

namespace diptych::core::tests {
namespace {

// Sets an environment variable for as long as it lives.
class Variable {
public:
    Variable(const char* name, const char* value) : name_(name) {
        if (const char* old = std::getenv(name)) {
            old_ = old;
        }
        setenv(name, value, 1);
    }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;
    ~Variable() {
        if (old_) {
            setenv(name_, old_->c_str(), 1);
        } else {
            unsetenv(name_);
        }
    }

private:
    const char* name_;
    std::optional<std::string> old_;
};

std::string refusal(const VulkanOptions& options) {
    try {
        make_vulkan_renderer(random_scene(1, 1, 1, 1), options);
    } catch (const NoDevice& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("A machine without the loader lists no devices and refuses to render, saying what to install") {
    const Variable loader("DIPTYCH_VULKAN_LOADER", "/nonexistent/libvulkan.so.1");
    CHECK(list_vulkan_devices().empty());
    const std::string text = refusal({});
    CHECK_THAT(text, Catch::Contains("/nonexistent/libvulkan.so.1") && Catch::Contains("libvulkan1"));
}

TEST_CASE("A machine without a driver refuses to render") {
    const Variable driver("VK_DRIVER_FILES", "/nonexistent/driver.json");
    const Variable old_driver("VK_ICD_FILENAMES", "/nonexistent/driver.json");
    CHECK(list_vulkan_devices().empty());
    CHECK_THAT(refusal({}), Catch::Contains("no Vulkan"));
}

TEST_CASE("A device that no one has is refused, naming those that there are") {
    NEED_VULKAN();
    const std::string name = list_vulkan_devices().front().name;
    CHECK_THAT(refusal({.device = "imaginary"}), Catch::Contains("\"imaginary\"") && Catch::Contains(name));
    CHECK_THAT(refusal({.device = "99"}), Catch::Contains("\"99\""));
}

TEST_CASE("A device is chosen by index and by a part of its name, whatever the case") {
    NEED_VULKAN();
    const VulkanInstance opened = open_instance(false);
    const std::string name = list_vulkan_devices().front().name;
    std::string part = name.substr(1, 5);
    for (char& c : part) {
        c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    }
    CHECK(describe_device(choose_device(opened.instance, "0")).name == name);
    CHECK(describe_device(choose_device(opened.instance, part)).name == name);
}

TEST_CASE("The best device is the most capable usable one, and one that lacks something is refused with the list") {
    const VulkanDeviceInfo big{
        .name = "Big", .type = "discrete", .driver = {}, .lacks = {"VK_KHR_ray_tracing_pipeline", "feature x"}};
    const VulkanDeviceInfo slow{.name = "Slow", .type = "cpu", .driver = {}, .usable = true, .lacks = {}};
    const VulkanDeviceInfo good{.name = "Good", .type = "discrete", .driver = {}, .usable = true, .lacks = {}};
    CHECK(choose_device_index({big, slow, good}, "") == 2);
    CHECK(choose_device_index({big, slow}, "") == 1);
    CHECK(choose_device_index({big, slow, good}, "slo") == 1);
    CHECK_THROWS_WITH(choose_device_index({big, slow}, "big"),
                      Catch::Contains("Big lacks VK_KHR_ray_tracing_pipeline, feature x"));
    CHECK_THROWS_WITH(choose_device_index({slow, big}, "1"), Catch::Contains("Big lacks"));
    CHECK_THROWS_WITH(choose_device_index({big}, ""),
                      Catch::Contains("no Vulkan device") && Catch::Contains("Big lacks"));
    CHECK_THROWS_AS(choose_device_index({}, ""), NoDevice);
}

}  // namespace diptych::core::tests
