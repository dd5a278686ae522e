// Where a scene is, and a camera that sees it.
#pragma once

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace diptych::core {

/// A box in world space, metres; empty where lo > hi.
struct Bounds {
    glm::dvec3 lo;
    glm::dvec3 hi;
};

bool is_empty(const Bounds& bounds);

/// The tight box around every vertex that a triangle of an instance uses.
Bounds scene_bounds(const Scene& scene);

/// A perspective camera of 45 degrees that sees the whole scene from the front (+Z) and slightly above, at any aspect
/// of 1 or more. A scene without extent is looked at from a distance of some units; an empty one as if a unit cube
/// stood at the origin.
Camera frame_scene(const Scene& scene);

}  // namespace diptych::core
