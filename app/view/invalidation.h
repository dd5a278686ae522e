// What becomes invalid from one state of the view to the next.
#pragma once

#include "view/view_state.h"

namespace diptych::app {

/// In rising order: each includes those before it.
enum class Invalidation {
    nothing,
    picture,   // another seed: the film begins anew
    view,      // the camera
    moment,    // time, light that turns or dims: what moves is packed again
    settings,  // integrator, size, features: Renderer::reconfigure
    scene,     // another scene: everything
};

/// Fields that decide no sample (files, backend, exposure) count for nothing.
Invalidation invalidation(const RenderedState& before, const RenderedState& after);

/// A light that is there or not is a matter of settings, since it changes what is packed; what it is like is one of the
/// moment.
bool same_settings(const RenderSettings& a, const RenderSettings& b);

}  // namespace diptych::app
