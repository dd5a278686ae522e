// Dear ImGui on a window.
#pragma once

#include "window/theme.h"
#include "window/window.h"

namespace diptych::core::app {

/// The current context while it lives; there is one at a time.
class ImguiContext {
public:
    explicit ImguiContext(const Window& window);
    ~ImguiContext();
    ImguiContext(const ImguiContext&) = delete;
    ImguiContext& operator=(const ImguiContext&) = delete;

    /// Fits theme and font to the window's density, or to `scale` where that is above 0; true where the font atlas was
    /// built anew.
    bool fit(const WindowInput& input, float scale);
    const Theme& theme() const { return theme_; }

    /// Begins a frame, with the picture behind all of it.
    void begin_frame();

private:
    const Window& window_;
    Theme theme_;
    float scale_ = 0;
    float ratio_ = 0;  // pixels a unit of the window
};

}  // namespace diptych::core::app
