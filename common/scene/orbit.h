// A camera that walks around what it looks at.
#pragma once

#include "scene/default_camera.h"
#include "scene/scene.h"

namespace diptych::core {

/// The point of the camera's axis nearest to the scene's centre, so that turning about it keeps it in the middle of the
/// picture; the centre itself where that lies behind the camera.
glm::dvec3 orbit_pivot(const Scene& scene, const Camera& camera);
glm::dvec3 orbit_pivot(const Bounds& bounds, const Camera& camera);

/// Turns the camera about the vertical (+Y) through `pivot`, counter-clockwise from above.
void orbit_camera(Camera& camera, const glm::dvec3& pivot, double degrees);

}  // namespace diptych::core
