// A window's swapchain, and the frames drawn into its images.
#pragma once

#include <optional>
#include <vector>

#include "device/gpu.h"

namespace diptych::core {

enum class SurfaceResult {
    ok,
    suboptimal,    // the image is shown; the swapchain should be recreated
    out_of_date,   // the image is not shown; the swapchain has to be recreated
    surface_lost,  // the image is not shown; the surface has to be recreated
};

class SurfaceLost : public Error {
public:
    using Error::Error;
};

enum class PresentMode {
    steady,  // waits for the display (FIFO); in some drivers with the queue locked, which delays renderers
    newest,  // does not wait and does not tear (mailbox), if the surface supports it; else as `steady`
};

/// R8G8B8A8 or B8G8R8A8 images with display values: everything drawn into them is already sRGB encoded.
struct Swapchain {
    vk::raii::SwapchainKHR handle = nullptr;
    vk::Format format = vk::Format::eUndefined;
    vk::Extent2D extent;
    std::vector<vk::Image> images;
    std::vector<vk::raii::ImageView> views;
    std::vector<vk::raii::Semaphore> drawn;  // one per image: presentation waits for it
};

/// Whether the queue can present to the surface.
bool presents_to(const Gpu& gpu, vk::SurfaceKHR surface);

/// `wanted` is used if the surface does not fix its size. Returns nothing if the surface has no area, as in a
/// minimised window. Replaces `old`, if given, which must outlive the frames in flight. Throws SurfaceLost or another
/// Error.
std::optional<Swapchain> make_swapchain(const Gpu& gpu, vk::SurfaceKHR surface, vk::Extent2D wanted, PresentMode mode,
                                        const Swapchain* old = nullptr);

/// A frame in flight.
class FrameSlot {
public:
    explicit FrameSlot(const Gpu& gpu);

    /// Waits for the slot's previous frame, acquires an image and, on `ok` and `suboptimal`, begins the commands.
    SurfaceResult begin(const Swapchain& swapchain);
    const vk::raii::CommandBuffer& commands() const { return commands_; }
    /// Index of the image to draw into. It is in layout eUndefined, and must be in ePresentSrcKHR at the end.
    std::uint32_t image() const { return image_; }
    /// Submits and presents. Commands that write the image must do so in eColorAttachmentOutput or later stages, or in
    /// eTransfer.
    SurfaceResult end(const Swapchain& swapchain);
    /// Waits for the slot's previous frame, if any.
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
