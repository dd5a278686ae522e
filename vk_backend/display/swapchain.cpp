#include "display/swapchain.h"

#include <algorithm>
#include <array>
#include <limits>

namespace diptych::core {
namespace {

constexpr std::uint64_t forever = std::numeric_limits<std::uint64_t>::max();

// Runs a call that acquires or presents images. Returns the surface's state; other errors are thrown.
template <typename Call>
SurfaceResult on_surface(const char* doing, Call&& call) {
    return in_context(doing, [&] {
        try {
            return call() == vk::Result::eSuboptimalKHR ? SurfaceResult::suboptimal : SurfaceResult::ok;
        } catch (const vk::OutOfDateKHRError&) {
            return SurfaceResult::out_of_date;
        } catch (const vk::SurfaceLostKHRError&) {
            return SurfaceResult::surface_lost;
        }
    });
}

vk::SurfaceFormatKHR choose_format(const Gpu& gpu, vk::SurfaceKHR surface) {
    const std::vector<vk::SurfaceFormatKHR> formats = gpu.physical.getSurfaceFormatsKHR(surface);
    for (const vk::Format wanted : {vk::Format::eB8G8R8A8Unorm, vk::Format::eR8G8B8A8Unorm}) {
        for (const vk::SurfaceFormatKHR& format : formats) {
            if (format.format == wanted && format.colorSpace == vk::ColorSpaceKHR::eSrgbNonlinear) {
                return format;
            }
        }
    }
    throw Error("Vulkan device " + gpu.name + ": the window's surface has no format of 8 bits a channel");
}

vk::PresentModeKHR choose_mode(const Gpu& gpu, vk::SurfaceKHR surface, PresentMode mode) {
    const std::vector<vk::PresentModeKHR> modes = gpu.physical.getSurfacePresentModesKHR(surface);
    const bool has_mailbox = std::find(modes.begin(), modes.end(), vk::PresentModeKHR::eMailbox) != modes.end();
    return mode == PresentMode::newest && has_mailbox ? vk::PresentModeKHR::eMailbox : vk::PresentModeKHR::eFifo;
}

// A surface that takes its size from the swapchain reports an extent of all ones.
vk::Extent2D choose_extent(const vk::SurfaceCapabilitiesKHR& surface, vk::Extent2D wanted) {
    if (surface.currentExtent.width != std::numeric_limits<std::uint32_t>::max()) {
        return surface.currentExtent;
    }
    if (wanted.width == 0 || wanted.height == 0) {
        return {0, 0};
    }
    return {std::clamp(wanted.width, surface.minImageExtent.width, surface.maxImageExtent.width),
            std::clamp(wanted.height, surface.minImageExtent.height, surface.maxImageExtent.height)};
}

vk::CompositeAlphaFlagBitsKHR choose_alpha(const vk::SurfaceCapabilitiesKHR& surface) {
    const bool opaque = static_cast<bool>(surface.supportedCompositeAlpha & vk::CompositeAlphaFlagBitsKHR::eOpaque);
    return opaque ? vk::CompositeAlphaFlagBitsKHR::eOpaque : vk::CompositeAlphaFlagBitsKHR::eInherit;
}

}  // namespace

bool presents_to(const Gpu& gpu, vk::SurfaceKHR surface) {
    return in_context("asking for the window's surface",
                      [&] { return gpu.physical.getSurfaceSupportKHR(gpu.queue_family, surface) == VK_TRUE; });
}

std::optional<Swapchain> make_swapchain(const Gpu& gpu, vk::SurfaceKHR surface, vk::Extent2D wanted, PresentMode mode,
                                        const Swapchain* old) {
    using Usage = vk::ImageUsageFlagBits;
    const auto make = [&]() -> std::optional<Swapchain> {
        const vk::SurfaceCapabilitiesKHR can = gpu.physical.getSurfaceCapabilitiesKHR(surface);
        Swapchain made;
        made.extent = choose_extent(can, wanted);
        if (made.extent.width == 0 || made.extent.height == 0) {
            return std::nullopt;
        }
        const vk::SurfaceFormatKHR format = choose_format(gpu, surface);
        made.format = format.format;
        const std::uint32_t most =
            can.maxImageCount > 0 ? can.maxImageCount : std::numeric_limits<std::uint32_t>::max();
        made.handle = gpu.device.createSwapchainKHR({
            .surface = surface,
            .minImageCount = std::min(can.minImageCount + 1, most),
            .imageFormat = format.format,
            .imageColorSpace = format.colorSpace,
            .imageExtent = made.extent,
            .imageArrayLayers = 1,
            .imageUsage =
                Usage::eColorAttachment | (can.supportedUsageFlags & (Usage::eTransferSrc | Usage::eTransferDst)),
            .imageSharingMode = vk::SharingMode::eExclusive,
            .preTransform = can.currentTransform,
            .compositeAlpha = choose_alpha(can),
            .presentMode = choose_mode(gpu, surface, mode),
            .clipped = VK_TRUE,
            .oldSwapchain = old != nullptr ? *old->handle : vk::SwapchainKHR{},
        });
        for (const auto& image : made.handle.getImages()) {
            made.images.emplace_back(image);
            made.views.push_back(gpu.device.createImageView(
                {.image = made.images.back(),
                 .viewType = vk::ImageViewType::e2D,
                 .format = made.format,
                 .subresourceRange = {
                     .aspectMask = vk::ImageAspectFlagBits::eColor, .levelCount = 1, .layerCount = 1}}));
            made.drawn.push_back(gpu.device.createSemaphore({}));
        }
        return made;
    };
    return in_context("making the swapchain", [&] {
        try {
            return make();
        } catch (const vk::SurfaceLostKHRError& error) {
            throw SurfaceLost(std::string("Vulkan: the window's surface is lost: ") + error.what());
        }
    });
}

FrameSlot::FrameSlot(const Gpu& gpu)
    : gpu_(gpu), pool_(gpu.device.createCommandPool({.queueFamilyIndex = gpu.queue_family})),
      acquired_(gpu.device.createSemaphore({})), done_(gpu.device.createFence({})) {
    commands_ = std::move(gpu.device.allocateCommandBuffers({.commandPool = *pool_, .commandBufferCount = 1}).front());
}

void FrameSlot::wait() {
    if (!in_flight_) {
        return;
    }
    in_context("waiting for a frame", [&] {
        wait_for(gpu_, *done_);
        gpu_.device.resetFences(*done_);
    });
    in_flight_ = false;
}

SurfaceResult FrameSlot::begin(const Swapchain& swapchain) {
    wait();
    const SurfaceResult result = on_surface("taking an image of the window", [&] {
        const auto [taken, image] = swapchain.handle.acquireNextImage(forever, *acquired_);
        image_ = image;
        return taken;
    });
    if (result == SurfaceResult::ok || result == SurfaceResult::suboptimal) {
        pool_.reset();
        commands_.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    }
    return result;
}

SurfaceResult FrameSlot::end(const Swapchain& swapchain) {
    return on_surface("showing a frame", [&] {
        commands_.end();
        constexpr vk::PipelineStageFlags drawing =
            vk::PipelineStageFlagBits::eColorAttachmentOutput | vk::PipelineStageFlagBits::eTransfer;
        const vk::SubmitInfo info{.waitSemaphoreCount = 1,
                                  .pWaitSemaphores = &*acquired_,
                                  .pWaitDstStageMask = &drawing,
                                  .commandBufferCount = 1,
                                  .pCommandBuffers = &*commands_,
                                  .signalSemaphoreCount = 1,
                                  .pSignalSemaphores = &*swapchain.drawn[image_]};
        submit(gpu_, info, *done_);
        in_flight_ = true;
        const std::lock_guard lock(gpu_.queue_mutex);
        return gpu_.queue.presentKHR({.waitSemaphoreCount = 1,
                                      .pWaitSemaphores = &*swapchain.drawn[image_],
                                      .swapchainCount = 1,
                                      .pSwapchains = &*swapchain.handle,
                                      .pImageIndices = &image_});
    });
}

}  // namespace diptych::core
