// From what is to be shown and what the panels have to what the display pass is told.
#pragma once

#include <memory>

#include "display_pass.h"
#include "view/panel_worker.h"
#include "view/view_state.h"
#include "window/legend.h"

namespace diptych::app {

/// One panel's film on the device, and what is known of it.
struct PanelFilm {
    DeviceFilm device;
    std::shared_ptr<const PanelShot> shot;  // null: no such panel
};

/// The request that shows `shown` in a picture of that width in pixels; `legend` becomes what its ramp means.
DisplayRequest choose_display(const ShownState& shown, const PanelFilm& cpu, const PanelFilm& vulkan, std::uint32_t width, Legend& legend);

}  // namespace diptych::app
