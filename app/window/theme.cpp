#include "window/theme.h"

#include <string_view>

#include "fonts.h"

namespace diptych::core::app {

namespace {

ImFont* add_font(const char* file, float pixels) {
    static constexpr ImWchar ranges[] = {0x20, 0x17f, 0x2010, 0x2026, 0x2070, 0x209c, 0x2200, 0x2265, 0};
    ImFontConfig config;
    config.FontDataOwnedByAtlas = false;
    config.OversampleH = 2;
    config.OversampleV = 1;
    config.PixelSnapH = false;
    config.RasterizerMultiply = 1.1F;
    const std::string_view data = font_data(file);
    // The atlas only reads what it does not own.
    void* bytes = const_cast<char*>(data.data());
    return ImGui::GetIO().Fonts->AddFontFromMemoryTTF(bytes, static_cast<int>(data.size()), pixels, &config, ranges);
}

void set_colors(ImGuiStyle& style) {
    ImVec4* c = style.Colors;
    const ImVec4 clear{0, 0, 0, 0};
    c[ImGuiCol_Text] = colors::text;
    c[ImGuiCol_TextDisabled] = colors::muted;
    c[ImGuiCol_WindowBg] = colors::panel;
    c[ImGuiCol_ChildBg] = clear;
    c[ImGuiCol_PopupBg] = {0.085F, 0.095F, 0.11F, 0.98F};
    c[ImGuiCol_Border] = colors::line;
    c[ImGuiCol_BorderShadow] = clear;
    c[ImGuiCol_FrameBg] = colors::field;
    c[ImGuiCol_FrameBgHovered] = colors::field_hovered;
    c[ImGuiCol_FrameBgActive] = colors::field_hovered;
    c[ImGuiCol_TitleBg] = c[ImGuiCol_TitleBgActive] = c[ImGuiCol_TitleBgCollapsed] = colors::panel;
    c[ImGuiCol_ScrollbarBg] = clear;
    c[ImGuiCol_ScrollbarGrab] = {1, 1, 1, 0.16F};
    c[ImGuiCol_ScrollbarGrabHovered] = {1, 1, 1, 0.26F};
    c[ImGuiCol_ScrollbarGrabActive] = {1, 1, 1, 0.34F};
    c[ImGuiCol_CheckMark] = colors::accent;
    c[ImGuiCol_SliderGrab] = colors::accent_dim;
    c[ImGuiCol_SliderGrabActive] = colors::accent;
    c[ImGuiCol_Button] = colors::field;
    c[ImGuiCol_ButtonHovered] = colors::field_hovered;
    c[ImGuiCol_ButtonActive] = colors::accent_dim;
    c[ImGuiCol_Header] = clear;
    c[ImGuiCol_HeaderHovered] = colors::field_hovered;
    c[ImGuiCol_HeaderActive] = colors::field_hovered;
    c[ImGuiCol_Separator] = colors::line;
    c[ImGuiCol_TableBorderLight] = colors::line;
    c[ImGuiCol_TableBorderStrong] = colors::line;
    c[ImGuiCol_TextSelectedBg] = {0.31F, 0.63F, 0.93F, 0.35F};
    c[ImGuiCol_NavHighlight] = colors::accent;
}

}  // namespace

Theme apply_theme(float scale, float ratio) {
    Theme theme;
    theme.scale = scale;
    theme.unit *= scale;
    theme.label *= scale;
    theme.panel *= scale;
    theme.bar *= scale;
    ImGui::GetIO().Fonts->Clear();
    theme.body = add_font("Roboto-Regular.ttf", 14 * scale * ratio);
    theme.strong = add_font("Roboto-Medium.ttf", 14 * scale * ratio);
    theme.small = add_font("Roboto-Regular.ttf", 12 * scale * ratio);
    ImGui::GetIO().Fonts->Build();
    ImGui::GetIO().FontGlobalScale = 1 / ratio;

    ImGuiStyle style;
    style.WindowPadding = {theme.units(3), theme.units(3)};
    style.FramePadding = {theme.units(2), theme.units(1)};
    style.ItemSpacing = {theme.units(2), theme.units(1.5F)};
    style.ItemInnerSpacing = {theme.units(1.5F), theme.units(1)};
    style.CellPadding = {theme.units(1), theme.units(0.5F)};
    style.IndentSpacing = theme.units(3);
    style.ScrollbarSize = theme.units(2);
    style.GrabMinSize = theme.units(1);
    style.WindowRounding = theme.units(2);
    style.ChildRounding = style.FrameRounding = style.PopupRounding = theme.units(1);
    style.GrabRounding = theme.units(0.5F);
    style.ScrollbarRounding = theme.units(1);
    style.WindowBorderSize = style.PopupBorderSize = scale;
    style.FrameBorderSize = 0;
    style.WindowMinSize = {theme.units(8), theme.units(8)};
    set_colors(style);
    ImGui::GetStyle() = style;
    return theme;
}

}  // namespace diptych::core::app
