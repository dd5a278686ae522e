#include "window/widgets.h"

#include <algorithm>
#include <cmath>

namespace diptych::core::app {

bool section(const Theme& theme, const char* title, bool open) {
    ImGui::Dummy({0, theme.units(0.5F)});
    ImGui::PushFont(theme.strong);
    ImGui::PushID(title);
    ImGuiStorage& kept = *ImGui::GetStateStorage();
    const ImGuiID id = ImGui::GetID("open");
    bool is_open = kept.GetBool(id, open);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float height = ImGui::GetFrameHeight();
    if (ImGui::InvisibleButton("fold", {std::max(ImGui::GetContentRegionAvail().x, 1.0F), height})) {
        is_open = !is_open;
        kept.SetBool(id, is_open);
    }
    const bool hovered = ImGui::IsItemHovered();
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float half = theme.units(0.9F);
    const ImVec2 mid{at.x + half, at.y + height / 2};
    const ImU32 color = packed(hovered ? colors::text : colors::muted);
    if (is_open) {
        draw.AddTriangleFilled({mid.x - half, mid.y - half / 2}, {mid.x + half, mid.y - half / 2},
                               {mid.x, mid.y + half / 2}, color);
    } else {
        draw.AddTriangleFilled({mid.x - half / 2, mid.y - half}, {mid.x + half / 2, mid.y},
                               {mid.x - half / 2, mid.y + half}, color);
    }
    draw.AddText({at.x + theme.units(3), at.y + ImGui::GetStyle().FramePadding.y}, packed(colors::text), title);
    ImGui::PopID();
    ImGui::PopFont();
    return is_open;
}

void explain(const char* text) {
    if (text != nullptr && ImGui::IsItemHovered()) {
        ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ImGui::GetFontSize() * 0.6F, ImGui::GetFontSize() * 0.4F});
        ImGui::BeginTooltip();
        ImGui::PushTextWrapPos(ImGui::GetFontSize() * 20);
        ImGui::TextUnformatted(text);
        ImGui::PopTextWrapPos();
        ImGui::EndTooltip();
        ImGui::PopStyleVar();
    }
}

void row(const Theme& theme, const char* label, const char* help) {
    const float left = ImGui::GetCursorPosX();
    ImGui::AlignTextToFramePadding();
    ImGui::PushStyleColor(ImGuiCol_Text, colors::muted);
    ImGui::TextUnformatted(label);
    ImGui::PopStyleColor();
    explain(help);
    ImGui::SameLine(left + theme.label, 0);
    ImGui::SetNextItemWidth(-1);
}

bool choice(const Theme& theme, const char* label, std::span<const char* const> names, int& chosen, const char* help) {
    row(theme, label, help);
    ImGui::PushID(label);
    const bool changed =
        ImGui::Combo("##choice", &chosen, names.data(), static_cast<int>(names.size()), static_cast<int>(names.size()));
    ImGui::PopID();
    return changed;
}

namespace {

bool number(const Theme& theme, const char* label, double& value, double least, double most, const char* format,
            const char* help, ImGuiSliderFlags flags) {
    row(theme, label, help);
    ImGui::PushID(label);
    const bool changed = ImGui::SliderScalar("##number", ImGuiDataType_Double, &value, &least, &most, format,
                                             flags | ImGuiSliderFlags_AlwaysClamp);
    ImGui::PopID();
    return changed;
}

}  // namespace

bool slider(const Theme& theme, const char* label, double& value, double least, double most, const char* format,
            const char* help) {
    return number(theme, label, value, least, most, format, help, 0);
}

bool logarithmic_slider(const Theme& theme, const char* label, double& value, double least, double most,
                        const char* format, const char* help) {
    return number(theme, label, value, least, most, format, help, ImGuiSliderFlags_Logarithmic);
}

namespace {

ImGuiSliderFlags flags_of(const SettingRange& setting) {
    return setting.scale == SliderScale::logarithmic ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None;
}

/// Not clamped to what the slider spans: a typed number may be any that is accepted.
template <typename Number>
bool setting_slider(const Theme& theme, const SettingRange& setting, ImGuiDataType type, Number& value,
                    const NumberRange& span, const char* format, const std::string& help) {
    row(theme, label_of(setting.name).c_str(), setting_help(setting.option(), help).c_str());
    ImGui::PushID(setting.name);
    const auto least = static_cast<Number>(span.least);
    const auto most = static_cast<Number>(span.most);
    Number next = value;
    const bool changed = ImGui::SliderScalar("##number", type, &next, &least, &most, format, flags_of(setting));
    ImGui::PopID();
    if (changed) {
        value = static_cast<Number>(nearest_accepted(setting, static_cast<double>(next), static_cast<double>(value)));
    }
    return changed;
}

}  // namespace

std::string setting_help(const char* option, const std::string& help) {
    return "--" + std::string(option) + "\n" + help;
}

bool slider(const Theme& theme, const SettingRange& setting, double& value, const char* format, const std::string& help,
            const std::optional<NumberRange>& span) {
    return setting_slider(theme, setting, ImGuiDataType_Double, value, span.value_or(setting.slider), format, help);
}

bool slider(const Theme& theme, const SettingRange& setting, float& value, const char* format,
            const std::string& help) {
    return setting_slider(theme, setting, ImGuiDataType_Float, value, setting.slider, format, help);
}

bool slider(const Theme& theme, const SettingRange& setting, std::uint32_t& value, const std::string& help) {
    return setting_slider(theme, setting, ImGuiDataType_U32, value, setting.slider, "%u", help);
}

bool setting_toggle(const Theme& theme, const char* setting, bool& value, const std::string& help) {
    return toggle(theme, label_of(setting).c_str(), value, setting_help(setting, help).c_str());
}

bool toggle(const Theme& theme, const char* label, bool& value, const char* help) {
    row(theme, label, help);
    ImGui::PushID(label);
    const bool changed = ImGui::Checkbox("##toggle", &value);
    ImGui::PopID();
    return changed;
}

bool segments(const char* id, std::span<const char* const> names, int& chosen, float width) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float height = ImGui::GetFrameHeight();
    const float part = std::floor(width / static_cast<float>(names.size()));
    const float rounding = ImGui::GetStyle().FrameRounding;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(at, {at.x + part * static_cast<float>(names.size()), at.y + height}, packed(colors::field),
                       rounding);
    const int before = chosen;
    ImGui::PushID(id);
    for (int i = 0; i < static_cast<int>(names.size()); ++i) {
        const char* name = names[static_cast<std::size_t>(i)];
        const ImVec2 from{at.x + part * static_cast<float>(i), at.y};
        ImGui::SetCursorScreenPos(from);
        if (ImGui::InvisibleButton(name, {part, height})) {
            chosen = i;
        }
        const bool down = chosen == i;
        if (down || ImGui::IsItemHovered()) {
            draw.AddRectFilled(from, {from.x + part, from.y + height},
                               packed(down ? colors::accent_dim : colors::field_hovered), rounding);
        }
        const ImVec2 size = ImGui::CalcTextSize(name);
        draw.AddText({from.x + std::floor((part - size.x) / 2), from.y + ImGui::GetStyle().FramePadding.y},
                     packed(down ? colors::text : colors::muted), name);
    }
    ImGui::PopID();
    ImGui::SetCursorScreenPos(at);
    ImGui::Dummy({part * static_cast<float>(names.size()), height});
    return chosen != before;
}

bool quiet_button(const char* text) {
    ImGui::PushStyleColor(ImGuiCol_Text, colors::muted);
    const bool pressed = ImGui::Button(text);
    ImGui::PopStyleColor();
    return pressed;
}

void note(const Theme& theme, const std::string& text, const ImVec4& color) {
    ImGui::PushFont(theme.small);
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopStyleColor();
    ImGui::PopFont();
}

void note_wrapped(const Theme& theme, const std::string& text, const ImVec4& color) {
    ImGui::PushTextWrapPos(0);
    note(theme, text, color);
    ImGui::PopTextWrapPos();
}

void right_aligned(const std::string& text, const ImVec4& color) {
    const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(room, 0.0F));
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopStyleColor();
}

ImU32 packed(const ImVec4& color) {
    return ImGui::ColorConvertFloat4ToU32(color);
}

}  // namespace diptych::core::app
