#include "window/imgui_context.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>

#include "window/imgui_pass.h"

namespace diptych::core::app {

ImguiContext::ImguiContext(const Window& window) : window_(window) {
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    ImGui_ImplGlfw_InitForVulkan(window.handle(), true);
}

ImguiContext::~ImguiContext() {
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

bool ImguiContext::fit(const WindowInput& input, float wanted) {
    int width = 0;
    int height = 0;
    glfwGetWindowSize(window_.handle(), &width, &height);
    if (width <= 0 || input.width <= 0) {
        return false;
    }
    const float ratio = static_cast<float>(input.width) / static_cast<float>(width);
    const float scale = wanted > 0 ? wanted : input.content_scale;
    if (scale == scale_ && ratio == ratio_) {
        return false;
    }
    scale_ = scale;
    ratio_ = ratio;
    theme_ = apply_theme(scale / ratio, ratio);
    return true;
}

void ImguiContext::begin_frame() {
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    // A pointer or a number, by ImGui's version.
    ImGui::GetBackgroundDrawList()->AddImage((ImTextureID)picture_texture, {0, 0}, ImGui::GetIO().DisplaySize);
}

}  // namespace diptych::core::app
