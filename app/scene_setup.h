// From a file and options to the scene that is rendered.
#pragma once

#include "arguments.h"
#include "scene/scene.h"

namespace diptych::app {

/// Loads the scene, puts the environment, the camera, its lens and the size in place, and reports the warnings, once
/// each. Without any light it gets a neutral sky, without a camera one that frames it, both with a warning. Throws
/// Error.
Scene prepare_scene(RenderArguments& arguments);

/// Whether anything in it emits.
bool has_light(const Scene& scene);

}  // namespace diptych::app
