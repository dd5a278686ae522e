#include "window/interface_layout.h"

#include <algorithm>

namespace diptych::core::app {

bool is_wide(const Theme& theme, ImVec2 size) {
    return size.x >= theme.units(220);
}

Layout layout_of(const Theme& theme, const InterfaceState& interface, ImVec2 size) {
    const float gap = theme.units(2);
    const float top = theme.bar + 2 * gap;
    const float height = std::max(size.y - top - gap, theme.units(10));
    Layout layout;
    layout.bar = {{gap, gap}, {size.x - 2 * gap, theme.bar}};
    const float panel = std::min(theme.panel, size.x - 4 * gap);
    layout.settings = {{gap, top}, {panel, height}};
    layout.figures = {{size.x - gap - panel, top}, {panel, height}};
    const float wide = std::min(2 * theme.panel, size.x - 3 * gap - (interface.settings ? panel : 0));
    layout.replay = {{size.x - gap - wide, top}, {wide, height}};
    const float left = interface.settings ? layout.settings.at.x + panel + gap : gap;
    const float right = interface.replay    ? layout.replay.at.x - gap
                        : interface.figures ? layout.figures.at.x - gap
                                            : size.x - gap;
    layout.middle = {{left, top}, {std::max(right - left, theme.units(20)), height}};
    return layout;
}

void begin_panel(const char* name, const Box& box) {
    ImGui::SetNextWindowPos(box.at);
    ImGui::SetNextWindowSizeConstraints({box.size.x, 0}, box.size);
    ImGui::SetNextWindowSize({box.size.x, 0});
    ImGui::Begin(name, nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav);
}

}  // namespace diptych::core::app
