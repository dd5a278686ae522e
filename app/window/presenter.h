// Frames in the window: the picture of the films, the interface over it.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "renderer/device_film.h"
#include "display/display_pass.h"
#include "display/swapchain.h"
#include "window/imgui_pass.h"
#include "window/window.h"

namespace diptych::core::app {

class Presenter {
public:
    /// The device was opened with surface_extensions and to present. Throws NoDevice where it cannot show anything in
    /// this window.
    Presenter(std::shared_ptr<Gpu> gpu, const Window& window);
    ~Presenter();
    Presenter(const Presenter&) = delete;
    Presenter& operator=(const Presenter&) = delete;

    /// Shows one frame of that size in pixels; false where the window had no place for it, which may pass: whatever has
    /// to be made anew has been. Throws DeviceLost.
    bool draw(const DisplayRequest& request, vk::Extent2D size, const ImDrawData& interface);

    /// Where the numbers of a frame shown of late lay; none where none were shown.
    const std::optional<DisplayRange>& range() const { return range_; }

    /// The picture of the last frame without the interface, as display values. Throws Error before the first of this
    /// size.
    Image picture() const;

    /// After the font atlas was built anew: the next frame takes it over.
    void reload_font();

private:
    bool make_ready(vk::Extent2D size);
    void wait();

    std::shared_ptr<Gpu> gpu_;
    const Window& window_;
    vk::raii::SurfaceKHR surface_ = nullptr;
    std::optional<Swapchain> swapchain_;
    DisplayPass display_;
    DisplayPicture picture_;
    std::unique_ptr<ImguiPass> interface_;
    std::array<FrameSlot, frames_in_flight> slots_;
    std::array<DisplayRequest, frames_in_flight> requests_;  // films that the frames in flight read
    std::optional<DisplayRange> range_;
    std::size_t next_ = 0;
    bool stale_ = true;        // the swapchain is to be made anew
    bool stale_font_ = false;  // and what draws the interface
    bool drawn_ = false;       // the picture has been recorded and submitted
};

}  // namespace diptych::core::app
