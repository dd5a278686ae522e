// The panel on the right: how fast, how far, how good, and whether both panels agree.
#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "console/report.h"
#include "window/interface_layout.h"
#include "window/widgets.h"

namespace diptych::core::app {

namespace {

using Shot = PanelShot;

std::vector<const PanelFacts*> shown_panels(const InterfaceFacts& facts) {
    std::vector<const PanelFacts*> panels;
    for (const PanelFacts& panel : facts.panels) {
        if (panel.shown && panel.shot != nullptr) {
            panels.push_back(&panel);
        }
    }
    return panels;
}

struct Figure {
    const char* label;
    std::function<std::string(const Shot&)> text;
};

std::string relmse_text(const Shot& shot) {
    return shot.figures.relmse ? fmt::format("{:.2e}", *shot.figures.relmse) : "–";
}

std::string size_text(const Shot& shot) {
    return shot.divisor > 1 ? fmt::format("{}×{} (1/{})", shot.width, shot.height, shot.divisor)
                            : fmt::format("{}×{}", shot.width, shot.height);
}

const std::vector<Figure>& figures() {
    static const std::vector<Figure> all = {
        {"Film", size_text},
        {"Samples", [](const Shot& s) { return fmt::format("{} spp", s.spp); }},
        {"Msamples/s", [](const Shot& s) { return fmt::format("{:.3g}", s.samples_per_second / 1e6); }},
        {"Mray/s", [](const Shot& s) { return fmt::format("{:.3g}", s.rays_per_second / 1e6); }},
        {"Frame", [](const Shot& s) { return fmt::format("{:.1f} ms", s.frame_milliseconds); }},
        {"Memory", [](const Shot& s) { return byte_text(static_cast<double>(s.costs.bytes)); }},
        {"relMSE", relmse_text},
        {"Non-finite", [](const Shot& s) { return fmt::format("{}", s.figures.nonfinite); }},
    };
    return all;
}

/// A table of labels and one right-aligned column a panel.
bool begin_columns(const Theme& theme, const char* id, std::size_t panels) {
    if (!ImGui::BeginTable(id, static_cast<int>(panels) + 1, ImGuiTableFlags_SizingStretchSame)) {
        return false;
    }
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, theme.label * 0.8F);
    return true;
}

void label_cell(const std::string& label) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushStyleColor(ImGuiCol_Text, colors::muted);
    ImGui::TextUnformatted(label.c_str());
    ImGui::PopStyleColor();
}

void draw_table(const Theme& theme, const std::vector<const PanelFacts*>& panels) {
    if (!begin_columns(theme, "figures", panels.size())) {
        return;
    }
    label_cell("");
    ImGui::PushFont(theme.strong);
    for (const PanelFacts* panel : panels) {
        ImGui::TableNextColumn();
        right_aligned(panel->title, panel->color);
    }
    ImGui::PopFont();
    for (const Figure& figure : figures()) {
        label_cell(figure.label);
        for (const PanelFacts* panel : panels) {
            ImGui::TableNextColumn();
            const bool wrong = std::string(figure.label) == "Non-finite" && panel->shot->figures.nonfinite > 0;
            right_aligned(panel->shot->width > 0 ? figure.text(*panel->shot) : "–", wrong ? colors::bad : colors::text);
        }
    }
    ImGui::EndTable();
}

/// Milliseconds of each pass of ris and restir.
void draw_passes(const Theme& theme, const std::vector<const PanelFacts*>& panels) {
    std::vector<std::string> names;
    for (const PanelFacts* panel : panels) {
        for (const PassTime& pass : panel->shot->passes) {
            if (std::find(names.begin(), names.end(), pass.pass) == names.end()) {
                names.push_back(pass.pass);
            }
        }
    }
    if (names.empty() || !section(theme, "Passes") || !begin_columns(theme, "passes", panels.size())) {
        return;
    }
    for (const std::string& name : names) {
        label_cell(name);
        for (const PanelFacts* panel : panels) {
            ImGui::TableNextColumn();
            const auto& passes = panel->shot->passes;
            const auto found =
                std::find_if(passes.begin(), passes.end(), [&](const PassTime& pass) { return pass.pass == name; });
            right_aligned(found == passes.end() ? "–" : fmt::format("{:.2f} ms", found->seconds * 1000));
        }
    }
    ImGui::EndTable();
}

ImVec4 color_of(Agreement agreement) {
    switch (agreement) {
    case Agreement::agree:
        return colors::good;
    case Agreement::doubtful:
        return colors::doubtful;
    case Agreement::differ:
        return colors::bad;
    default:
        return colors::muted;
    }
}

void draw_light(const Theme& theme, const VerificationLight& light) {
    const float radius = theme.units(1.25F);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImVec4 color = color_of(light.agreement);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImVec2 mid{at.x + 2 * radius, at.y + ImGui::GetTextLineHeight() / 2};
    draw.AddCircleFilled(mid, radius * 1.8F, packed({color.x, color.y, color.z, 0.25F}));
    draw.AddCircleFilled(mid, radius, packed(color));
    ImGui::Dummy({4 * radius, ImGui::GetTextLineHeight()});
    ImGui::SameLine();
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(light.text.c_str());
    ImGui::PopTextWrapPos();
    explain("z of Welch's test between the image means of both panels, of the worst channel. The panels have "
            "different seeds. Below 3 they agree.");
}

void draw_devices(const Theme& theme, const std::vector<const PanelFacts*>& panels) {
    for (const PanelFacts* panel : panels) {
        if (!panel->shot->device.empty()) {
            note_wrapped(theme, panel->shot->device, panel->color);
        }
        if (!panel->shot->error.empty()) {
            note_wrapped(theme, panel->shot->error, colors::bad);
        }
    }
}

}  // namespace

void draw_figures(const Theme& theme, const InterfaceFacts& facts, const ViewState& state) {
    const std::vector<const PanelFacts*> panels = shown_panels(facts);
    ImGui::PushFont(theme.strong);
    ImGui::TextUnformatted(fmt::format("{:.0f} fps", facts.frames_per_second).c_str());
    ImGui::PopFont();
    ImGui::SameLine();
    right_aligned(state.paused ? "paused" : "", colors::muted);
    draw_devices(theme, panels);
    if (shows_both(state.shown)) {
        draw_light(theme, facts.light);
    }
    draw_table(theme, panels);
    draw_passes(theme, panels);
    if (section(theme, "Estimated relMSE")) {
        draw_error_plot(theme, facts);
    }
}

}  // namespace diptych::core::app
