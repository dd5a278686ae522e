#include "window/view_commands.h"

#include <algorithm>

#include "settings/ranges.h"

namespace diptych::core::app {

namespace {

/// The value `steps` on, round and round among `count`.
template <typename Enum>
void step_through(Enum& value, int steps, int count) {
    value = static_cast<Enum>((static_cast<int>(value) + steps + count) % count);
}

constexpr int panel_count = 4;
constexpr int layer_count = 10;
constexpr int integrator_count = 5;
constexpr int tonemap_count = 5;
constexpr double exposure_step = 0.25;  // EV

void set_exposure(ShownState& shown, double exposure) {
    shown.exposure = std::clamp(exposure, ranges::exposure.accepted.least, ranges::exposure.accepted.most);
}

}  // namespace

void run_command(Command command, bool both, ViewState& state, InterfaceState& interface) {
    ShownState& shown = state.shown;
    Integrator& integrator = state.rendered.request.settings.integrator;
    switch (command) {
    case Command::hide_interface:
        interface.visible = !interface.visible;
        break;
    case Command::help:
        interface.help = !interface.help;
        break;
    case Command::next_panel:
        if (both) {
            step_through(shown.panel, 1, panel_count);
        }
        break;
    case Command::next_layer:
        step_through(shown.layer, 1, layer_count);
        break;
    case Command::previous_layer:
        step_through(shown.layer, -1, layer_count);
        break;
    case Command::next_integrator:
        step_through(integrator, 1, integrator_count);
        break;
    case Command::previous_integrator:
        step_through(integrator, -1, integrator_count);
        break;
    case Command::next_tonemap:
        step_through(shown.tonemap, 1, tonemap_count);
        break;
    case Command::brighter:
        set_exposure(shown, shown.exposure + exposure_step);
        break;
    case Command::darker:
        set_exposure(shown, shown.exposure - exposure_step);
        break;
    case Command::play:
        state.animation.playing = !state.animation.playing && state.animation.duration > 0;
        break;
    case Command::close:
        interface.messages.clear();
        interface.help = interface.replay = false;
        break;
    case Command::focus:
        interface.wishes.focus = true;
        break;
    case Command::reset_camera:
        interface.wishes.reset_camera = true;
        break;
    case Command::screenshot:
        interface.wishes.screenshot = true;
        break;
    case Command::save_exr:
        interface.wishes.save_exr = true;
        break;
    case Command::copy_command:
        interface.wishes.copy_command = true;
        break;
    case Command::quit:
        interface.wishes.quit = true;
        break;
    }
}

}  // namespace diptych::core::app
