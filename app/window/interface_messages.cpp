// What has happened, below the top bar: errors until they are closed, notes for a while, what is being waited for.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "window/interface_layout.h"
#include "window/widgets.h"

namespace diptych::core::app {

namespace {

constexpr double note_seconds = 4;

/// One line on a ground of its own, wrapped in the middle; true where it was closed.
bool draw_message(const Theme& theme, const char* name, const std::string& text, const ImVec4& mark, bool closable,
                  const Box& middle, float& y) {
    const float cross = closable ? theme.units(7) : 0;
    const float room = std::min(middle.size.x, theme.units(150)) - theme.units(8) - cross;
    const float text_width = std::min(ImGui::CalcTextSize(text.c_str(), nullptr, false, room).x + 1, room);
    const float width = text_width + theme.units(8) + cross;
    ImGui::SetNextWindowPos({middle.at.x + (middle.size.x - width) / 2, y});
    ImGui::SetNextWindowSize({width, 0});
    ImGui::Begin(name, nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav |
                     ImGuiWindowFlags_NoScrollbar);
    const ImVec2 at = ImGui::GetWindowPos();
    ImGui::SetCursorPosX(theme.units(4));
    ImGui::PushTextWrapPos(theme.units(4) + room + 1);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    bool closed = false;
    if (closable) {
        ImGui::SameLine(width - theme.units(8));
        ImGui::PushID("close");
        const ImVec2 corner = ImGui::GetCursorScreenPos();
        const float side = ImGui::GetTextLineHeight();
        closed = ImGui::InvisibleButton("close", {side, side});
        const ImU32 color = packed(ImGui::IsItemHovered() ? colors::text : colors::muted);
        const float a = side * 0.3F;
        const float b = side * 0.7F;
        ImGui::GetWindowDrawList()->AddLine({corner.x + a, corner.y + a}, {corner.x + b, corner.y + b}, color,
                                            1.5F * theme.scale);
        ImGui::GetWindowDrawList()->AddLine({corner.x + b, corner.y + a}, {corner.x + a, corner.y + b}, color,
                                            1.5F * theme.scale);
        ImGui::PopID();
    }
    const float height = ImGui::GetWindowHeight();
    const float left = at.x + theme.units(2);  // inside of what a window clips its content to
    ImGui::GetWindowDrawList()->AddRectFilled(
        {left, at.y + theme.units(2.5F)}, {left + theme.units(0.5F), at.y + height - theme.units(2.5F)}, packed(mark));
    ImGui::End();
    y += height + theme.units(1.5F);
    return closed;
}

}  // namespace

void show_message(InterfaceState& interface, const std::string& text, bool error, double now) {
    std::erase_if(interface.messages, [&](const Message& message) { return message.text == text; });
    interface.messages.push_back({text, error, now + note_seconds});
}

void draw_messages(const Theme& theme, const InterfaceFacts& facts, InterfaceState& interface) {
    const Box middle = layout_of(theme, interface, ImGui::GetIO().DisplaySize).middle;
    float y = interface.visible ? middle.at.y : theme.units(2);
    if (!facts.loading.empty()) {
        draw_message(theme, "loading", "loading " + std::filesystem::path(facts.loading).filename().string() + " …",
                     colors::accent, false, middle, y);
    }
    for (const PanelFacts& panel : facts.panels) {
        if ((panel.shown || interface.replay) && panel.shot != nullptr && !panel.shot->busy.empty()) {
            draw_message(theme, panel.title, fmt::format("{}: {} …", panel.title, panel.shot->busy), panel.color, false,
                         middle, y);
        }
    }
    std::erase_if(interface.messages,
                  [&](const Message& message) { return !message.error && message.until < facts.now; });
    for (std::size_t i = 0; i < interface.messages.size();) {
        const Message& message = interface.messages[i];
        const bool closed = draw_message(theme, fmt::format("message {}", i).c_str(), message.text,
                                         message.error ? colors::bad : colors::accent, message.error, middle, y);
        if (closed) {
            interface.messages.erase(interface.messages.begin() + static_cast<std::ptrdiff_t>(i));
        } else {
            ++i;
        }
    }
}

}  // namespace diptych::core::app
