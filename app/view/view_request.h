// A view's state as a command line can say it.
#pragma once

#include "scene/scene.h"
#include "view/view_state.h"

namespace diptych::core::app {

/// The request with which `render` shows what the state shows: viewpoint and lens where they are not those of the
/// scene's own camera, and the moment where the scene moves. `loaded` is the state's scene.
RenderRequest view_request(const RenderedState& state, const Scene& loaded);

}  // namespace diptych::core::app
