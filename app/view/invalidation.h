// What becomes invalid from one state of the view to the next.
#pragma once

#include "render/moment.h"
#include "view/view_state.h"

namespace diptych::core::app {

/// Fields that decide no sample (files, backend, exposure) count for nothing.
Change invalidation(const RenderedState& before, const RenderedState& after);

}  // namespace diptych::core::app
