// What a scene needs to be seen, where its file does not have it.
#pragma once

#include <string>

#include "scene/scene.h"

namespace diptych::core {

/// Lights a scene by a neutral sky where its own light leaves it black (own_light.h). Adds a warning, with `remedy`
/// behind it: how to do without. Returns whether it did. The scene has no environment before.
bool add_missing_light(Scene& scene, const std::string& remedy = "");

/// Adds a camera that frames the scene where it has none. Returns whether it did.
bool add_missing_camera(Scene& scene);

}  // namespace diptych::core
