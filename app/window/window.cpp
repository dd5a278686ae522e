#include "window/window.h"

#define GLFW_INCLUDE_NONE
#include <vulkan/vulkan_core.h>
// After Vulkan's own header, which makes it declare surfaces.
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "error.h"

namespace diptych::core::app {

namespace {

std::string glfw_reason() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text == nullptr ? "no reason given" : text;
}

#ifdef GLFW_PLATFORM  // GLFW 3.4 and later

bool is_absolute_path(const char* variable) {
    const char* value = std::getenv(variable);
    return value != nullptr && value[0] == '/';
}

/// GLFW tries Wayland before X11. Where the environment leads to no compositor, libwayland prints an error about
/// XDG_RUNTIME_DIR, even if X11 then opens the window. X11 alone is tried there.
void choose_platform() {
    const bool may_have_wayland = std::getenv("WAYLAND_SOCKET") != nullptr || is_absolute_path("WAYLAND_DISPLAY") ||
                                  is_absolute_path("XDG_RUNTIME_DIR");
    if (!may_have_wayland && glfwPlatformSupported(GLFW_PLATFORM_X11) == GLFW_TRUE) {
        glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
    }
}

#else

void choose_platform() {}  // older GLFW is built for one platform

#endif

void start_glfw() {
    choose_platform();
    if (glfwInit() != GLFW_TRUE) {
        throw NoDevice(
            fmt::format("view: no window could be opened ({}); without a display use `diptych view --headless`, "
                        "`diptych render --frames N` or, to watch from afar, `diptych render --live HOST:PORT`",
                        glfw_reason()));
    }
}

WindowInput& input_of(GLFWwindow* window) {
    WindowInput& input = *static_cast<WindowInput*>(glfwGetWindowUserPointer(window));
    input.any = true;
    return input;
}

/// From the window's own units to pixels of the framebuffer.
glm::dvec2 in_pixels(GLFWwindow* window, double x, double y) {
    int width = 0;
    int height = 0;
    int pixel_width = 0;
    int pixel_height = 0;
    glfwGetWindowSize(window, &width, &height);
    glfwGetFramebufferSize(window, &pixel_width, &pixel_height);
    return {x * pixel_width / std::max(width, 1), y * pixel_height / std::max(height, 1)};
}

glm::dvec2 cursor_of(GLFWwindow* window) {
    double x = 0;
    double y = 0;
    glfwGetCursorPos(window, &x, &y);
    return in_pixels(window, x, y);
}

void on_key(GLFWwindow* window, int key, int, int action, int mods) {
    if (action == GLFW_RELEASE) {
        input_of(window);
        return;
    }
    input_of(window).keys.push_back({.key = key,
                                     .ctrl = (mods & GLFW_MOD_CONTROL) != 0,
                                     .shift = (mods & GLFW_MOD_SHIFT) != 0,
                                     .alt = (mods & GLFW_MOD_ALT) != 0,
                                     .repeated = action == GLFW_REPEAT});
}

void on_button(GLFWwindow* window, int button, int action, int mods) {
    if (button > GLFW_MOUSE_BUTTON_MIDDLE) {
        return;
    }
    input_of(window).presses.push_back({.button = static_cast<MouseButton>(button),
                                        .down = action == GLFW_PRESS,
                                        .at = cursor_of(window),
                                        .ctrl = (mods & GLFW_MOD_CONTROL) != 0,
                                        .shift = (mods & GLFW_MOD_SHIFT) != 0,
                                        .alt = (mods & GLFW_MOD_ALT) != 0});
}

void on_drop(GLFWwindow* window, int count, const char** paths) {
    WindowInput& input = input_of(window);
    input.dropped.insert(input.dropped.end(), paths, paths + count);
}

void watch(GLFWwindow* window) {
    glfwSetKeyCallback(window, on_key);
    glfwSetMouseButtonCallback(window, on_button);
    glfwSetDropCallback(window, on_drop);
    glfwSetScrollCallback(window, [](GLFWwindow* w, double, double y) { input_of(w).scroll += y; });
    glfwSetCursorPosCallback(window, [](GLFWwindow* w, double, double) { input_of(w); });
    glfwSetCharCallback(window, [](GLFWwindow* w, unsigned) { input_of(w); });
    glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { input_of(w); });
    glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { input_of(w); });
    glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int) { input_of(w); });
}

}  // namespace

Window::Window(const std::string& title, int width, int height) : input_(std::make_unique<WindowInput>()) {
    start_glfw();
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    handle_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
    if (handle_ == nullptr) {
        const std::string reason = glfw_reason();
        glfwTerminate();
        throw NoDevice("no window: " + reason);
    }
    glfwSetWindowSizeLimits(handle_, 320, 200, GLFW_DONT_CARE, GLFW_DONT_CARE);
    glfwSetWindowUserPointer(handle_, input_.get());
    watch(handle_);
}

Window::~Window() {
    glfwDestroyWindow(handle_);
    glfwTerminate();
}

WindowInput Window::poll(double seconds) {
    if (seconds > 0) {
        glfwWaitEventsTimeout(seconds);
    } else {
        glfwPollEvents();
    }
    WindowInput input = std::exchange(*input_, {});
    input.closed = glfwWindowShouldClose(handle_) == GLFW_TRUE;
    input.focused = glfwGetWindowAttrib(handle_, GLFW_FOCUSED) == GLFW_TRUE;
    glfwGetFramebufferSize(handle_, &input.width, &input.height);
    if (glfwGetWindowAttrib(handle_, GLFW_ICONIFIED) == GLFW_TRUE) {
        input.width = input.height = 0;
    }
    float scale_y = 1;
    glfwGetWindowContentScale(handle_, &input.content_scale, &scale_y);
    input.cursor = cursor_of(handle_);
    return input;
}

bool Window::holds(int key) const {
    return glfwGetKey(handle_, key) == GLFW_PRESS;
}

void Window::set_title(const std::string& title) {
    glfwSetWindowTitle(handle_, title.c_str());
}

void Window::set_clipboard(const std::string& text) {
    glfwSetClipboardString(handle_, text.c_str());
}

VkSurfaceKHR_T* Window::make_surface(VkInstance_T* instance) const {
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    const VkResult result = glfwCreateWindowSurface(instance, handle_, nullptr, &surface);
    if (result != VK_SUCCESS) {
        throw Error(
            fmt::format("no Vulkan surface for the window: {} (VkResult {})", glfw_reason(), static_cast<int>(result)));
    }
    return surface;
}

std::vector<std::string> surface_extensions() {
    std::uint32_t count = 0;
    const char** names = glfwGetRequiredInstanceExtensions(&count);
    if (names == nullptr) {
        throw NoDevice("no window: Vulkan cannot show anything on this display (" + glfw_reason() + ")");
    }
    return {names, names + count};
}

void check_display() {
    start_glfw();
    glfwTerminate();
}

void wake_window() {
    glfwPostEmptyEvent();
}

}  // namespace diptych::core::app
