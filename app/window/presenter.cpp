#include "window/presenter.h"

namespace diptych::core::app {

namespace {

vk::raii::SurfaceKHR make_surface(const Gpu& gpu, const Window& window) {
    return {gpu.vulkan.instance, window.make_surface(*gpu.vulkan.instance)};
}

}  // namespace

Presenter::Presenter(std::shared_ptr<Gpu> gpu, const Window& window)
    : gpu_(std::move(gpu)), window_(window), surface_(make_surface(*gpu_, window)),
      display_(make_display_pass(*gpu_)), slots_{FrameSlot(*gpu_), FrameSlot(*gpu_)} {
    if (!presents_to(*gpu_, *surface_)) {
        throw NoDevice("no window: " + gpu_->name + " cannot show anything on this display");
    }
}

Presenter::~Presenter() {
    try {
        wait();
    } catch (const Error&) {  // a lost device has nothing in flight
    }
}

void Presenter::wait() {
    for (FrameSlot& slot : slots_) {
        slot.wait();
    }
    wait_idle(*gpu_);  // presentation has no fence
}

bool Presenter::make_ready(vk::Extent2D size) {
    if (size.width == 0 || size.height == 0) {
        return false;
    }
    if (stale_ || !swapchain_ || swapchain_->extent != size) {
        wait();
        std::optional<Swapchain> made =
            make_swapchain(*gpu_, *surface_, size, PresentMode::newest, swapchain_ ? &*swapchain_ : nullptr);
        swapchain_ = std::move(made);
        if (!swapchain_) {
            return false;
        }
        if (interface_ == nullptr || stale_font_) {
            interface_ = std::make_unique<ImguiPass>(*gpu_, swapchain_->format);
            stale_font_ = false;
        }
        interface_->set_targets(*swapchain_);
        stale_ = false;
    }
    if (picture_.width != swapchain_->extent.width || picture_.height != swapchain_->extent.height) {
        wait();
        drawn_ = false;
        picture_ = make_display_picture(*gpu_, display_, swapchain_->extent.width, swapchain_->extent.height);
    }
    return true;
}

bool Presenter::draw(const DisplayRequest& request, vk::Extent2D size, const ImDrawData& interface) {
    const auto lost = [&] {
        swapchain_.reset();
        surface_ = nullptr;
        surface_ = make_surface(*gpu_, window_);
        stale_ = true;
        return false;
    };
    try {
        if (!make_ready(size)) {
            return false;
        }
    } catch (const SurfaceLost&) {
        wait();
        return lost();
    }
    const std::size_t number = next_;
    FrameSlot& slot = slots_[number];
    SurfaceResult result = slot.begin(*swapchain_);
    if (result == SurfaceResult::ok || result == SurfaceResult::suboptimal) {
        stale_ = result == SurfaceResult::suboptimal;
        range_ =
            shown_range(picture_, static_cast<std::uint32_t>(number));  // of the slot's last frame, which has ended
        requests_[number] = request;
        record_display(slot.commands(), display_, picture_, request, static_cast<std::uint32_t>(number));
        interface_->record(slot.commands(), slot.image(), number, *picture_.view, interface);
        result = slot.end(*swapchain_);
        drawn_ = true;
        next_ = (next_ + 1) % frames_in_flight;
    }
    if (result == SurfaceResult::surface_lost) {
        wait();
        return lost();
    }
    stale_ = stale_ || result != SurfaceResult::ok;
    return result != SurfaceResult::out_of_date;
}

Image Presenter::picture() const {
    if (!drawn_) {
        throw Error("there is no picture yet");
    }
    return read_display(*gpu_, picture_);
}

void Presenter::reload_font() {
    stale_ = stale_font_ = true;
}

}  // namespace diptych::core::app
