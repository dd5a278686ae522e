// Names of what a view can show, as options and logs have them.
#pragma once

#include <string>

#include "view/view_state.h"

namespace diptych::core::app {

const char* name_of(ShownPanel panel);
const char* name_of(ShownLayer layer);

/// Throws Error, listing the names there are.
ShownPanel shown_panel_from_name(const std::string& name);

}  // namespace diptych::core::app
