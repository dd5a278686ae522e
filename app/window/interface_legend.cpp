// The ramp of colours along the bottom, where numbers are shown.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "../shaders/display_colors.h"
#include "window/interface_layout.h"
#include "window/widgets.h"

namespace diptych::core::app {

namespace {

ImU32 color_at(const Legend& legend, float t) {
    const glm::vec3 c = legend.difference ? shared::signed_color(2 * t - 1) : shared::ramp_color(t);
    return packed({c.x, c.y, c.z, 1});
}

std::string number_text(double value, const std::string& unit) {
    return fmt::format("{:.3g}{}{}", value, unit.empty() ? "" : " ", unit);
}

}  // namespace

void draw_legend(const Theme& theme, const Legend& legend, const ViewState& state, const InterfaceState& interface) {
    const Box middle = layout_of(theme, interface, ImGui::GetIO().DisplaySize).middle;
    const float above = state.animation.duration > 0 && interface.visible ? theme.bar + theme.units(2) : 0;
    const float pad = theme.units(2);
    const ImVec2 size{std::min(theme.units(64), middle.size.x - 4 * pad), theme.units(3)};
    const float line = ImGui::GetTextLineHeight();
    const ImVec2 at{std::round(middle.at.x + (middle.size.x - size.x) / 2),
                    std::round(middle.at.y + middle.size.y - above - size.y - line - 2 * pad)};
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    draw.AddRectFilled({at.x - 2 * pad, at.y - pad}, {at.x + size.x + 2 * pad, at.y + size.y + line + 2 * pad},
                       packed(colors::panel), theme.units(2));
    constexpr int steps = 64;
    for (int i = 0; i < steps; ++i) {
        const float a = static_cast<float>(i) / steps;
        const float b = static_cast<float>(i + 1) / steps;
        draw.AddRectFilledMultiColor({at.x + size.x * a, at.y}, {at.x + size.x * b, at.y + size.y}, color_at(legend, a),
                                     color_at(legend, b), color_at(legend, b), color_at(legend, a));
    }
    const float y = at.y + size.y + theme.units(0.5F);
    const std::string low = number_text(legend.difference ? -legend.high : legend.low, "");
    const std::string high = number_text(legend.high, legend.unit);
    draw.AddText({at.x, y}, packed(colors::text), low.c_str());
    draw.AddText({at.x + size.x - ImGui::CalcTextSize(high.c_str()).x, y}, packed(colors::text), high.c_str());
    const char* note = legend.difference ? "CPU − Vulkan" : legend.logarithmic ? "logarithmic" : "";
    draw.AddText({at.x + (size.x - ImGui::CalcTextSize(note).x) / 2, y}, packed(colors::muted), note);
}

}  // namespace diptych::core::app
