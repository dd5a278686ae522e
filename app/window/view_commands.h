// What a key asks for, done to the state.
#pragma once

#include "view/view_state.h"
#include "window/interface.h"
#include "window/shortcuts.h"

namespace diptych::core::app {

/// Changes the state, or notes a wish where more than the state is needed. `both`: whether there are two panels to
/// choose from.
void run_command(Command command, bool both, ViewState& state, InterfaceState& interface);

}  // namespace diptych::core::app
