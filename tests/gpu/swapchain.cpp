// Frames on a surface without a window.
#include "display/swapchain.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "gpu_fixture.h"

namespace diptych::core::tests {
namespace {

bool has_headless_surfaces() {
    const VulkanInstance opened = open_instance(false);
    const auto extensions = opened.context.enumerateInstanceExtensionProperties();
    return std::any_of(extensions.begin(), extensions.end(), [](const auto& extension) {
        return std::string_view(extension.extensionName.data()) == VK_EXT_HEADLESS_SURFACE_EXTENSION_NAME;
    });
}

std::shared_ptr<Gpu> open_presenting_gpu() {
    return open_gpu({.device = "",
                     .validation = test_options().validation,
                     .instance_extensions = {VK_KHR_SURFACE_EXTENSION_NAME, VK_EXT_HEADLESS_SURFACE_EXTENSION_NAME},
                     .presents = true});
}

void transition(const vk::raii::CommandBuffer& commands, vk::Image image, vk::ImageLayout from, vk::ImageLayout to) {
    using Access = vk::AccessFlagBits;
    using Stage = vk::PipelineStageFlagBits;
    const vk::ImageMemoryBarrier barrier{
        .srcAccessMask = Access::eTransferWrite,
        .dstAccessMask = Access::eTransferWrite,
        .oldLayout = from,
        .newLayout = to,
        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .image = image,
        .subresourceRange = {.aspectMask = vk::ImageAspectFlagBits::eColor, .levelCount = 1, .layerCount = 1}};
    commands.pipelineBarrier(Stage::eTransfer, Stage::eTransfer, {}, {}, {}, barrier);
}

/// Clears the image and shows it.
SurfaceResult show_frame(FrameSlot& slot, const Swapchain& swapchain) {
    const SurfaceResult begun = slot.begin(swapchain);
    if (begun != SurfaceResult::ok) {
        return begun;
    }
    const vk::Image image = swapchain.images[slot.image()];
    using Layout = vk::ImageLayout;
    transition(slot.commands(), image, Layout::eUndefined, Layout::eTransferDstOptimal);
    slot.commands().clearColorImage(
        image, Layout::eTransferDstOptimal, vk::ClearColorValue(std::array{0.2F, 0.4F, 0.6F, 1.0F}),
        vk::ImageSubresourceRange{.aspectMask = vk::ImageAspectFlagBits::eColor, .levelCount = 1, .layerCount = 1});
    transition(slot.commands(), image, Layout::eTransferDstOptimal, Layout::ePresentSrcKHR);
    return slot.end(swapchain);
}

}  // namespace

TEST_CASE("Frames are shown on a surface, through a change of size and of mode") {
    NEED_VULKAN();
    if (!has_headless_surfaces()) {
        SKIP_TEST("no VK_EXT_headless_surface");
    }
    const std::shared_ptr<Gpu> gpu = open_presenting_gpu();
    const vk::raii::SurfaceKHR surface = gpu->vulkan.instance.createHeadlessSurfaceEXT({});
    REQUIRE(presents_to(*gpu, *surface));
    CHECK_FALSE(make_swapchain(*gpu, *surface, {0, 32}, PresentMode::steady));
    std::array<FrameSlot, frames_in_flight> slots{FrameSlot(*gpu), FrameSlot(*gpu)};
    std::optional<Swapchain> swapchain = make_swapchain(*gpu, *surface, {48, 32}, PresentMode::newest);
    REQUIRE(swapchain);
    CHECK(swapchain->extent == vk::Extent2D{48, 32});
    CHECK(swapchain->images.size() >= 2);
    CHECK(swapchain->views.size() == swapchain->images.size());
    for (std::size_t frame = 0; frame < 8; ++frame) {
        CHECK(show_frame(slots[frame % frames_in_flight], *swapchain) == SurfaceResult::ok);
    }
    std::optional<Swapchain> next = make_swapchain(*gpu, *surface, {20, 30}, PresentMode::steady, &*swapchain);
    REQUIRE(next);
    CHECK(next->extent == vk::Extent2D{20, 30});
    wait_idle(*gpu);
    for (FrameSlot& slot : slots) {
        slot.wait();
    }
    swapchain = std::move(next);
    for (std::size_t frame = 0; frame < 8; ++frame) {
        CHECK(show_frame(slots[frame % frames_in_flight], *swapchain) == SurfaceResult::ok);
    }
    wait_idle(*gpu);
    check_no_validation_messages();
}

TEST_CASE("An unknown extension of the instance is no device to show on") {
    NEED_VULKAN();
    CHECK_THROWS_AS(open_gpu({.device = "", .instance_extensions = {"VK_KHR_no_such_surface"}, .presents = true}),
                    NoDevice);
}

}  // namespace diptych::core::tests
