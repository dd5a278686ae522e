// A window's swapchain, and the frames that are drawn into its images.
#pragma once

#include <optional>
#include <vector>

#include "device/gpu.h"

namespace diptych::core {

enum class SurfaceResult {
    ok,
    suboptimal,    // shown all the same; better made anew
    out_of_date,   // not shown: make the swapchain anew
    surface_lost,  // not shown: make the surface anew
};

class SurfaceLost : public Error {
public:
    using Error::Error;
};

enum class PresentMode {
    steady,  // waits for the display (FIFO), some drivers with the queue held, which keeps renderers waiting too
    newest,  // never waits, never tears (mailbox), where the surface has it; else as `steady`
};

/// Images in R8G8B8A8 or B8G8R8A8 whose values are display values: what is drawn has been sRGB encoded already.
struct Swapchain {
    vk::raii::SwapchainKHR handle = nullptr;
    vk::Format format = vk::Format::eUndefined;
    vk::Extent2D extent;
    std::vector<vk::Image> images;
    std::vector<vk::raii::ImageView> views;
    std::vector<vk::raii::Semaphore> drawn;  // one an image: presentation waits for it
};

/// Whether the queue can present to the surface.
bool presents_to(const Gpu& gpu, vk::SurfaceKHR surface);

/// `wanted` counts where the surface leaves its size open. Nothing while the surface has no area, as a minimised
/// window's. `old`, if any, is replaced, and must outlive the frames in flight. Throws SurfaceLost or another Error.
std::optional<Swapchain> make_swapchain(const Gpu& gpu, vk::SurfaceKHR surface, vk::Extent2D wanted, PresentMode mode,
                                        const Swapchain* old = nullptr);

/// One of the frames in flight.
class FrameSlot {
public:
    explicit FrameSlot(const Gpu& gpu);

    /// Waits for the slot's last frame, takes an image and begins the commands; on ok and suboptimal alone.
    SurfaceResult begin(const Swapchain& swapchain);
    const vk::raii::CommandBuffer& commands() const { return commands_; }
    /// The index of the image to draw into, in layout eUndefined; it must be left in ePresentSrcKHR.
    std::uint32_t image() const { return image_; }
    /// Submits and presents. What draws into the image must do so in eColorAttachmentOutput or later stages, or in
    /// eTransfer.
    SurfaceResult end(const Swapchain& swapchain);
    /// Waits for the slot's last frame, if any.
    void wait();

private:
    const Gpu& gpu_;
    vk::raii::CommandPool pool_;
    vk::raii::CommandBuffer commands_ = nullptr;
    vk::raii::Semaphore acquired_;
    vk::raii::Fence done_;
    std::uint32_t image_ = 0;
    bool in_flight_ = false;
};

constexpr std::size_t frames_in_flight = 2;

}  // namespace diptych::core
