// The panel of a pixel's path on both backends, vertex by vertex.
#include <fmt/format.h>

#include <algorithm>

#include "measure/replay_rows.h"
#include "window/interface_layout.h"
#include "window/widgets.h"

namespace diptych::core::app {

namespace {

ImVec4 color_of(const std::string& backend) {
    return backend == "cpu" ? colors::cpu : colors::vulkan;
}

void draw_rows(const Theme& theme, const std::vector<ReplayRow>& rows, std::size_t panels) {
    for (const ReplayRow& row : rows) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        note(theme, row.label, row.marked ? colors::bad : colors::muted);
        for (std::size_t i = 0; i < panels; ++i) {
            ImGui::TableNextColumn();
            note(theme, row.cells[i], colors::text);
        }
        if (panels > 1) {
            ImGui::TableNextColumn();
            ImGui::PushFont(theme.small);
            right_aligned(row.difference, row.marked ? colors::bad : colors::muted);
            ImGui::PopFont();
        }
    }
}

bool begin_rows(const Theme& theme, const char* id, std::size_t panels) {
    const int columns = panels > 1 ? 4 : 2;
    if (!ImGui::BeginTable(id, columns, ImGuiTableFlags_SizingStretchSame)) {
        return false;
    }
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, theme.units(25));
    for (std::size_t i = 0; i < panels; ++i) {
        ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 1);
    }
    if (panels > 1) {
        ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, theme.units(12));
    }
    return true;
}

void draw_paths(const Theme& theme, const Replay& replay) {
    const std::size_t panels = replay.paths.size();
    if (begin_rows(theme, "heads", panels)) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        for (const std::string& backend : replay.backends) {
            ImGui::TableNextColumn();
            note(theme, backend == "cpu" ? "CPU" : "Vulkan", color_of(backend));
        }
        if (panels > 1) {
            ImGui::TableNextColumn();
            ImGui::PushFont(theme.small);
            right_aligned("differ by", colors::muted);
            ImGui::PopFont();
        }
        ImGui::EndTable();
    }
    for (const ReplayGroup& group : replay_groups(replay, nullptr, 4)) {
        if (section(theme, group.title.c_str()) && begin_rows(theme, group.title.c_str(), panels)) {
            draw_rows(theme, group.rows, panels);
            ImGui::EndTable();
        }
    }
}

}  // namespace

void draw_replay(const Theme& theme, const PixelReplay& replay, InterfaceState& interface) {
    begin_panel("replay", layout_of(theme, interface, ImGui::GetIO().DisplaySize).replay);
    ImGui::PushFont(theme.strong);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(fmt::format("Pixel {}, {}", replay.query().pixel.x, replay.query().pixel.y).c_str());
    ImGui::PopFont();
    ImGui::SameLine(theme.label + theme.units(6));
    ImGui::PushStyleColor(ImGuiCol_Text, colors::muted);
    ImGui::TextUnformatted("sample");
    ImGui::PopStyleColor();
    ImGui::SameLine();
    ImGui::SetNextItemWidth(theme.units(28));
    int sample = static_cast<int>(replay.query().sample_index);
    if (ImGui::InputInt("##sample", &sample) && sample >= 0) {
        interface.wishes.replay_sample = static_cast<std::uint32_t>(sample);
    }
    const float width = ImGui::CalcTextSize("Close").x + 2 * ImGui::GetStyle().FramePadding.x;
    ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - width);
    if (quiet_button("Close")) {
        interface.replay = false;
    }
    if (replay.waiting()) {
        note(theme, "tracing …");
    }
    if (!replay.error().empty()) {
        note_wrapped(theme, replay.error(), colors::bad);
    }
    const Replay& result = replay.result();
    if (!result.paths.empty()) {
        if (result.paths.size() > 1) {
            note_wrapped(theme, parting_text(result), result.parting ? colors::bad : colors::good);
        }
        draw_paths(theme, result);
    }
    ImGui::End();
}

}  // namespace diptych::core::app
