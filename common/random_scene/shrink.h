// Makes a scene that fails as small as it can be, so that what is left shows the fault.
#pragma once

#include <functional>

#include "random_scene/random_scene.h"

namespace diptych::core {

/// Whether a scene still shows the fault.
using StillFails = std::function<bool(const RandomScene&)>;

/// What hangs in nodes leaves them: its matrix says the same. False where there are no nodes, or an animation moves one.
bool drop_nodes(Scene& scene);

/// Drops one part after another (animations, instances, lights, the sky, textures, factors of materials, vertex attributes, depth,
/// the lens) as long as the scene fails without it, until nothing can be dropped or `most_trials` scenes were tried.
RandomScene shrink(RandomScene failing, const StillFails& still_fails, int most_trials = 200);

}  // namespace diptych::core
