// The bar along the top: which panel, which layer, by which integrator.
#include <algorithm>
#include <array>
#include <map>
#include <string>

#include "window/interface_layout.h"
#include "window/widgets.h"

namespace diptych::core::app {

namespace {

constexpr std::array panel_names = {"Vulkan", "CPU", "Split", "Difference"};
constexpr std::array layer_names = {"Radiance", "Albedo", "Normal",      "Depth",       "Standard error",
                                    "Samples",  "Light",  "Reservoir M", "Reservoir W", "Non-finite"};
constexpr std::array integrator_names = {"brdf", "direct", "path", "ris", "restir"};

using Places = std::map<std::string, ImVec2>;

/// Notes where the last item is.
void mark(Places& places, const std::string& name) {
    const ImVec2 least = ImGui::GetItemRectMin();
    const ImVec2 most = ImGui::GetItemRectMax();
    places[name] = {(least.x + most.x) / 2, (least.y + most.y) / 2};
}

template <typename Enum, std::size_t Count>
void drop_down(const char* name, const std::array<const char*, Count>& names, Enum& chosen, float width,
               const char* help, Places& places) {
    const auto index = static_cast<std::size_t>(chosen);
    ImGui::SetNextItemWidth(width);
    ImGui::PushID(name);
    const bool open = ImGui::BeginCombo("##choice", names[index], ImGuiComboFlags_HeightLargest);
    if (!open) {
        mark(places, name);
        explain(help);
    } else {
        for (std::size_t i = 0; i < Count; ++i) {
            if (ImGui::Selectable(names[i], i == index)) {
                chosen = static_cast<Enum>(i);
            }
            mark(places, std::string(name) + ":" + names[i]);
        }
        ImGui::EndCombo();
    }
    ImGui::PopID();
}

void choose_panel(const Theme& theme, const InterfaceFacts& facts, ShownState& shown, bool narrow, Places& places) {
    const bool both = facts.panels[0].shot != nullptr && facts.panels[1].shot != nullptr;
    if (!both) {
        const char* name = facts.panels[facts.panels[0].shot != nullptr ? 0 : 1].title;
        ImGui::PushFont(theme.strong);
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(name);
        ImGui::PopFont();
        return;
    }
    constexpr const char* help = "Panels to show  (P)";
    if (narrow) {
        drop_down("panel", panel_names, shown.panel, theme.units(24), help, places);
    } else {
        int index = static_cast<int>(shown.panel);
        segments("panel", panel_names, index, theme.units(80));
        shown.panel = static_cast<ShownPanel>(index);
        mark(places, "panel");
        explain(help);
    }
}

/// Buttons from the right end leftward, each shown while there is room for it.
class ButtonsFromRight {
public:
    explicit ButtonsFromRight(float least) : least_(least), right_(ImGui::GetWindowContentRegionMax().x) {}

    bool operator()(const char* text, const char* help) {
        const float width = ImGui::CalcTextSize(text).x + 2 * ImGui::GetStyle().FramePadding.x;
        const float spacing = ImGui::GetStyle().ItemSpacing.x;
        if (right_ - width < least_ + spacing) {
            return false;
        }
        ImGui::SameLine(right_ - width);
        right_ -= width + spacing;
        const bool pressed = quiet_button(text);
        explain(help);
        return pressed;
    }

private:
    float least_;
    float right_;
};

}  // namespace

bool shows_both(const ShownState& shown) {
    return shown.panel == ShownPanel::split || shown.panel == ShownPanel::difference;
}

void draw_top_bar(const Theme& theme, const InterfaceFacts& facts, ViewState& state, InterfaceState& interface) {
    const Box box = layout_of(theme, interface, ImGui::GetIO().DisplaySize).bar;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {theme.units(2.5F), theme.units(2.5F)});
    begin_panel("bar", box);
    const bool wide = is_wide(theme, ImGui::GetIO().DisplaySize);
    choose_panel(theme, facts, state.shown, !wide, interface.places);
    ImGui::SameLine();
    drop_down("layer", layer_names, state.shown.layer, theme.units(34), "Layer of the picture  (L)",
              interface.places);
    ImGui::SameLine();
    drop_down("integrator", integrator_names, state.rendered.request.settings.integrator, theme.units(22),
              "Integrator  (I)", interface.places);
    ImGui::SameLine(0, 0);
    ButtonsFromRight button(ImGui::GetCursorPosX());
    if (button("Keys", "Keys and mouse  (H)")) {
        interface.help = !interface.help;
    }
    if (button("Figures", "Show or hide the figures at the right")) {
        interface.figures = !interface.figures;
        interface.settings = interface.settings && (wide || !interface.figures);
    }
    if (button("Settings", "Show or hide the settings at the left")) {
        interface.settings = !interface.settings;
        if (!wide && interface.settings) {
            interface.figures = interface.replay = false;
        }
    }
    if (button("Save PNG", "The picture as it is seen, without the interface  (Ctrl+S)")) {
        interface.wishes.screenshot = true;
    }
    if (button("Save EXR", "Radiance and layers as a file  (Ctrl+Shift+S)")) {
        interface.wishes.save_exr = true;
    }
    if (button("Copy command", "Copy the command line that renders this picture  (Ctrl+C)")) {
        interface.wishes.copy_command = true;
    }
    ImGui::End();
    ImGui::PopStyleVar();
}

}  // namespace diptych::core::app
