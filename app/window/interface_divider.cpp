// The line of a split view, and which side is which.
#include <algorithm>
#include <cmath>

#include "window/interface_layout.h"
#include "window/widgets.h"

namespace diptych::core::app {

void draw_divider(const Theme& theme, ViewState& state, InterfaceState& interface) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float reach = theme.units(2);
    const float x = std::round(static_cast<float>(state.shown.divider) * size.x);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
    ImGui::SetNextWindowPos({x - reach, 0});
    ImGui::SetNextWindowSize({2 * reach, size.y});
    ImGui::Begin("divider", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoScrollbar |
                     ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    ImGui::InvisibleButton("line", {2 * reach, size.y});
    const bool hot = ImGui::IsItemHovered() || ImGui::IsItemActive();
    interface.dividing = ImGui::IsItemActive();
    if (interface.dividing) {
        state.shown.divider = std::clamp(static_cast<double>(ImGui::GetIO().MousePos.x / size.x), 0.0, 1.0);
    }
    if (hot) {
        ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    }
    ImGui::End();
    ImGui::PopStyleVar(3);

    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const float width = theme.scale * (hot ? 2.0F : 1.0F);
    const Box middle = layout_of(theme, interface, size).middle;
    const float top = interface.visible ? middle.at.y - theme.units(2) : 0;
    draw.AddRectFilled({x - width, top}, {x + width, size.y}, packed({0, 0, 0, 0.5F}));
    draw.AddRectFilled({x - width / 2, top}, {x + width / 2, size.y}, packed({1, 1, 1, 0.9F}));
    const float y = std::round(middle.at.y + middle.size.y - theme.units(state.animation.duration > 0 ? 24 : 12));
    const auto tag = [&](const char* text, const ImVec4& color, bool left) {
        const ImVec2 room = ImGui::CalcTextSize(text);
        const float at = left ? x - room.x - theme.units(5) : x + theme.units(5);
        draw.AddRectFilled({at - theme.units(2), y - theme.units(1)},
                           {at + room.x + theme.units(2), y + room.y + theme.units(1)}, packed(colors::panel),
                           theme.units(1));
        draw.AddText({at, y}, packed(color), text);
    };
    tag("CPU", colors::cpu, true);
    tag("Vulkan", colors::vulkan, false);
}

}  // namespace diptych::core::app
