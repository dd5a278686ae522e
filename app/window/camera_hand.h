// From mouse and keys to what the camera does.
#pragma once

#include <optional>

#include "view/loader.h"
#include "view/view_state.h"
#include "window/window.h"

namespace diptych::core::app {

struct KeptFilm;

/// What of a frame's input is the camera's, and not the interface's.
struct HandInput {
    const WindowInput* window = nullptr;
    bool mouse_is_free = false;  // the pointer is over the picture
    bool keys_are_free = false;
    glm::dvec3 steps{0};  // held keys: right, up, forward
    bool fast = false;    // Shift
    double seconds = 0;   // since the last frame
};

/// A press that did not move.
struct Click {
    glm::dvec2 at{};  // pixels
};

class CameraHand {
public:
    /// Changes state.rendered.camera; the pointer's wishes are relative to a window of its size.
    void update(const HandInput& input, const LoadedScene& scene, ViewState& state);

    /// Whether changes keep coming.
    bool moving() const { return moving_; }
    /// A click of the left button on the picture in the last update.
    std::optional<Click> click() const { return click_; }

private:
    struct Drag {
        MouseButton button = MouseButton::left;
        bool pans = false;
        glm::dvec2 start{};
        glm::dvec2 last{};
        bool moved = false;  // beyond what a click trembles
    };

    void follow_presses(const HandInput& input);
    void drag_to(const glm::dvec2& at, const glm::dvec2& size, const LoadedScene& scene, ViewState& state);

    std::optional<Drag> drag_;
    std::optional<Click> click_;
    std::optional<glm::dvec2> released_at_;  // in the last update
    bool moving_ = false;
    double still_ = 1;  // seconds since the wheel turned
};

/// Sets focus and pivot to what the picture shows at that point of the window, in [0, 1]^2; false where that is
/// nothing.
bool focus_at(const glm::dvec2& point, const KeptFilm& picture, ViewState& state);

}  // namespace diptych::core::app
