// The window, its input and its clipboard, over GLFW.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

struct GLFWwindow;
struct VkInstance_T;
struct VkSurfaceKHR_T;

namespace diptych::core::app {

enum class MouseButton { left, right, middle };

struct KeyPress {
    int key = 0;  // GLFW_KEY_*, by its place on a US keyboard
    bool ctrl = false;
    bool shift = false;
    bool alt = false;
    bool repeated = false;  // held down
};

/// A button that went down or up, and where.
struct MousePress {
    MouseButton button = MouseButton::left;
    bool down = false;
    glm::dvec2 at{};
    bool ctrl = false;
    bool shift = false;
    bool alt = false;
};

/// What happened since the last poll, and how things stand. Positions in pixels of the framebuffer, from its upper left
/// corner.
struct WindowInput {
    bool closed = false;
    int width = 0;  // of the framebuffer; 0 while the window is minimised
    int height = 0;
    float content_scale = 1;  // 2 on a display of twice the usual density
    bool focused = false;
    glm::dvec2 cursor{};
    double scroll = 0;  // notches away from the user
    std::vector<KeyPress> keys;
    std::vector<MousePress> presses;
    std::vector<std::string> dropped;  // files
    bool any = false;                  // whether anything happened at all
};

class Window {
public:
    /// Throws NoDevice where there is no display.
    Window(const std::string& title, int width, int height);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// Waits until something happens, `seconds` at most, and tells what did.
    WindowInput poll(double seconds);

    /// Whether the key is down.
    bool holds(int key) const;

    void set_title(const std::string& title);
    void set_clipboard(const std::string& text);

    /// A Vulkan surface (VkInstance, VkSurfaceKHR), which is the caller's. Throws Error.
    VkSurfaceKHR_T* make_surface(VkInstance_T* instance) const;

    GLFWwindow* handle() const { return handle_; }

private:
    GLFWwindow* handle_ = nullptr;
    std::unique_ptr<WindowInput> input_;  // gathered by the callbacks
};

/// What an instance needs for surfaces on this display. GLFW must be up, as it is while a Window lives. Throws NoDevice
/// where the display or the Vulkan loader cannot show anything.
std::vector<std::string> surface_extensions();

/// Throws NoDevice, saying what to do instead, where no window could be opened.
void check_display();

/// Wakes a poll from any thread.
void wake_window();

}  // namespace diptych::core::app
