// What is lost while a view is open: its surface, its swapchain, its device. A loader between it and the driver
// (losing_loader) says so, at the call that is asked for.
#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "catch.h"
#include "open_display.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

struct Loss {
    const char* order;  // the call, and its VkResult
    bool of_device;
};

/// Written whole before it has its name, so that no half of an order is read.
void give_order(const std::string& file, const std::string& order) {
    std::ofstream(file + ".new") << order << '\n';
    std::filesystem::rename(file + ".new", file);
}

bool is_obeyed(const std::string& file) {
    for (int i = 0; i < 2000 && std::filesystem::exists(file); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return !std::filesystem::exists(file);
}

/// Opens a view and has it lose one thing after another.
void check_losses(const VirtualDisplay& display, const TemporaryFolder& folder, const std::string& scene,
                  const std::vector<Loss>& losses) {
    const std::string order = folder.file("order");
    DrivenView view(display, folder, scene, {"--panel", "vulkan", "--scale", "0.1", "--max-depth", "2"},
                    {std::string("DIPTYCH_VULKAN_LOADER=") + LOSING_LOADER, "DIPTYCH_LOSE=" + order});
    view.await("spp", is_settled);
    for (const Loss& loss : losses) {
        INFO(loss.order);
        const Event error = view.latest("error");
        give_order(order, loss.order);
        REQUIRE(is_obeyed(order));
        if (loss.of_device) {
            view.await("recovered");
            view.await("spp", is_settled);
            continue;
        }
        // What was accumulated stays, and grows.
        const Event before = view.latest("spp");
        const Event after = view.await("spp", [&](const Event& event) { return event["spp"] > before["spp"]; });
        CHECK(after["version"] == before["version"]);
        CHECK(view.latest("error") == error);
    }
    view.key("ctrl+s");
    CHECK(view.await("screenshot")["file"].get<std::string>().ends_with(".png"));
    check_clean(view.quit());
}

}  // namespace

// After a device the film begins anew, and so soon doubles, which a surface's loss waits for: hence their order.
TEST_CASE("a view outlives lost surfaces and lost devices", "[view_window]") {
    OPEN_DISPLAY(display, folder, scene)
    check_losses(display, folder, scene,
                 {{"vkAcquireNextImageKHR -1000001004", false},  // out of date
                  {"vkQueueSubmit -4", true},                    // the device is lost
                  {"vkQueuePresentKHR -1000000000", false},      // the surface is lost
                  {"vkQueuePresentKHR -4", true}});
}

TEST_CASE("a view outlives losses that any call may tell of", "[view_window][nightly]") {
    OPEN_DISPLAY(display, folder, scene)
    check_losses(display, folder, scene,
                 {{"vkQueuePresentKHR -1000001004", false},
                  {"vkWaitForFences -4", true},
                  {"vkAcquireNextImageKHR -1000000000", false},
                  {"vkAcquireNextImageKHR -4", true},
                  {"vkQueuePresentKHR 1000001003", false}});  // suboptimal
}
