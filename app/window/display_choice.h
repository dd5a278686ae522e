// From what is to be shown and what the panels have to what the display pass is told.
#pragma once

#include <optional>

#include "display/display_pass.h"
#include "view/view_state.h"
#include "window/legend.h"

namespace diptych::core::app {

/// The request that shows `shown` in a picture of that width in pixels; `legend` becomes what its ramp means. `seen` is
/// where the numbers of the frame before lay.
DisplayRequest choose_display(const ShownState& shown, const DeviceFilm& cpu, const DeviceFilm& vulkan,
                              std::uint32_t width, const std::optional<DisplayRange>& seen, Legend& legend);

}  // namespace diptych::core::app
