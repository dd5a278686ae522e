// The bar along the bottom of a scene that moves.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "window/interface_layout.h"
#include "window/widgets.h"

namespace diptych::core::app {

namespace {

constexpr std::array speeds = {0.1, 0.25, 0.5, 1.0, 2.0, 4.0};
constexpr std::array speed_names = {"0.1×", "0.25×", "0.5×", "1×", "2×", "4×"};

/// A triangle or two bars.
bool play_button(const Theme& theme, bool playing) {
    const float side = ImGui::GetFrameHeight();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const bool pressed = ImGui::Button("##play", {side * 1.5F, side});
    explain("Play or pause  (Space)");
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImVec2 mid{at.x + side * 0.75F, at.y + side / 2};
    const float r = theme.units(1.5F);
    const ImU32 color = packed(colors::text);
    if (playing) {
        draw.AddRectFilled({mid.x - r * 0.8F, mid.y - r}, {mid.x - r * 0.2F, mid.y + r}, color);
        draw.AddRectFilled({mid.x + r * 0.2F, mid.y - r}, {mid.x + r * 0.8F, mid.y + r}, color);
    } else {
        draw.AddTriangleFilled({mid.x - r * 0.7F, mid.y - r}, {mid.x + r, mid.y}, {mid.x - r * 0.7F, mid.y + r}, color);
    }
    return pressed;
}

}  // namespace

void draw_animation_bar(const Theme& theme, ViewState& state, const InterfaceState& interface) {
    const Box middle = layout_of(theme, interface, ImGui::GetIO().DisplaySize).middle;
    const float width = std::min(middle.size.x, theme.units(150));
    const ImVec2 size{width, theme.bar};
    const ImVec2 at{middle.at.x + (middle.size.x - width) / 2, middle.at.y + middle.size.y - size.y};
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {theme.units(2.5F), theme.units(2.5F)});
    begin_panel("animation", {at, size});
    if (play_button(theme, state.animation.playing)) {
        state.animation.playing = !state.animation.playing;
    }
    ImGui::SameLine();
    const float speed_width = theme.units(18);
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - speed_width - ImGui::GetStyle().ItemSpacing.x);
    double least = 0;
    const std::string format = fmt::format("%.2f / {:.2f} s", state.animation.duration);
    if (ImGui::SliderScalar("##time", ImGuiDataType_Double, &state.rendered.time, &least, &state.animation.duration,
                            format.c_str(), ImGuiSliderFlags_AlwaysClamp)) {
        state.animation.playing = false;
    }
    ImGui::SameLine();
    int chosen = 3;
    for (std::size_t i = 0; i < speeds.size(); ++i) {
        chosen = std::abs(speeds[i] - state.animation.speed) < 1e-9 ? static_cast<int>(i) : chosen;
    }
    ImGui::SetNextItemWidth(speed_width);
    if (ImGui::Combo("##speed", &chosen, speed_names.data(), static_cast<int>(speed_names.size()))) {
        state.animation.speed = speeds[static_cast<std::size_t>(chosen)];
    }
    explain("Playback speed: scene seconds per second");
    ImGui::End();
    ImGui::PopStyleVar();
}

}  // namespace diptych::core::app
