// The page of keys.
#include "window/interface_layout.h"
#include "window/shortcuts.h"
#include "window/widgets.h"

namespace diptych::core::app {

namespace {

void begin_list(const Theme& theme, const char* title, float keys) {
    ImGui::PushFont(theme.strong);
    ImGui::TextUnformatted(title);
    ImGui::PopFont();
    ImGui::BeginTable(title, 2, ImGuiTableFlags_SizingFixedFit);
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, keys);
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch);
}

void line(const char* keys, const char* text) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushStyleColor(ImGuiCol_Text, colors::accent);
    ImGui::TextUnformatted(keys);
    ImGui::PopStyleColor();
    ImGui::TableNextColumn();
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
}

}  // namespace

void draw_help(const Theme& theme, InterfaceState& interface) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize(size);
    ImGui::PushStyleColor(ImGuiCol_WindowBg, {0, 0, 0, 0.55F});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
    ImGui::Begin("behind help", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoNav);
    ImGui::End();
    ImGui::PopStyleVar();
    ImGui::PopStyleColor();
    const float width = std::min(theme.units(196), size.x - theme.units(4));
    ImGui::SetNextWindowPos({size.x / 2, size.y / 2}, 0, {0.5F, 0.5F});
    ImGui::SetNextWindowSizeConstraints({width, 0}, {width, size.y - theme.units(4)});
    ImGui::SetNextWindowSize({width, 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {theme.units(5), theme.units(4)});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, {colors::panel.x, colors::panel.y, colors::panel.z, 0.97F});
    ImGui::Begin("help", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                     ImGuiWindowFlags_NoSavedSettings);
    const bool wide = width > theme.units(150);
    if (wide) {
        ImGui::BeginTable("columns", 2, ImGuiTableFlags_SizingStretchProp);
        ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 1.12F);
        ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 1);
        ImGui::TableNextColumn();
    }
    begin_list(theme, "Keys", theme.units(16));
    for (const Shortcut& shortcut : shortcuts()) {
        if (shortcut.text[0] != '\0') {
            line(shortcut.keys, shortcut.text);
        }
    }
    ImGui::EndTable();
    if (wide) {
        ImGui::TableNextColumn();
    } else {
        ImGui::Dummy({0, theme.units(2)});
    }
    begin_list(theme, "Mouse and hand", theme.units(28));
    for (const Gesture& gesture : gestures()) {
        line(gesture.hand, gesture.text);
    }
    ImGui::EndTable();
    if (wide) {
        ImGui::EndTable();
    }
    // A click beside it closes it.
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left) &&
        !ImGui::IsWindowHovered(ImGuiHoveredFlags_RootAndChildWindows |
                                ImGuiHoveredFlags_AllowWhenBlockedByActiveItem)) {
        interface.help = false;
    }
    ImGui::End();
    ImGui::PopStyleColor();
    ImGui::PopStyleVar();
}

}  // namespace diptych::core::app
