// From a file and options to the scene that is rendered.
#pragma once

#include "render/request.h"
#include "scene/scene.h"

namespace diptych::core::app {

/// Loads the scene, chooses its clips, puts the environment, the sun, the camera and its lens in place. Where its own
/// light leaves it black it gets a neutral sky, without a camera one that frames it, both with a warning. Says nothing:
/// warnings are in the scene. Throws Error.
Scene place_requested(RenderRequest& request);

/// Reports the warnings of the clips that play, for a command that plays them. Throws Error instead where the request
/// is strict.
void report_clips(const Scene& scene, const RenderRequest& request);

/// The first half of place_requested: the file with its clips, environment and cameras; settings.camera becomes that of
/// the request. Says nothing: warnings are in the scene. Throws Error.
Scene load_requested(RenderRequest& request);

}  // namespace diptych::core::app
