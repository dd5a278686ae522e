#include "window/interface.h"

#include <algorithm>

#include "window/interface_layout.h"
#include "window/widgets.h"

namespace diptych::core::app {

void draw_interface(const Theme& theme, const InterfaceFacts& facts, ViewState& state, InterfaceState& interface,
                    const PixelReplay& replay) {
    if (!is_wide(theme, ImGui::GetIO().DisplaySize) && interface.settings && (interface.figures || interface.replay)) {
        interface.settings = false;
    }
    if (state.shown.panel == ShownPanel::split) {
        draw_divider(theme, state, interface);
    }
    if (facts.legend.shown) {
        draw_legend(theme, facts.legend, state, interface);
    }
    if (interface.visible) {
        draw_top_bar(theme, facts, state, interface);
        if (interface.settings) {
            draw_settings(theme, facts, state, interface);
        }
        if (interface.replay) {
            draw_replay(theme, replay, interface);
        } else if (interface.figures) {
            begin_panel("figures", layout_of(theme, interface, ImGui::GetIO().DisplaySize).figures);
            draw_figures(theme, facts, state);
            ImGui::End();
        }
        if (state.animation.duration > 0) {
            draw_animation_bar(theme, state, interface);
        }
    }
    draw_messages(theme, facts, interface);
    if (interface.help) {
        draw_help(theme, interface);
    }
}

}  // namespace diptych::core::app
