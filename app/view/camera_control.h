// What a hand does to a camera: pure functions. Film points are in [0, 1]^2, y down; angles in radians; distances in
// metres.
#pragma once

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace diptych::core::app {

/// Turns about `pivot`: `yaw` about the vertical (+Y), counter-clockwise from above, then `pitch`, which raises the
/// camera. It stops short of the poles; a roll stays.
void orbit(Camera& camera, const glm::dvec3& pivot, double yaw, double pitch);

/// Turns about the camera itself: `yaw` to the left, `pitch` up; stops short of the poles.
void look(Camera& camera, double yaw, double pitch);

/// Along its own right, up and forward.
void fly(Camera& camera, const glm::dvec3& steps);

/// Metres a second at which a scene of such a diagonal is flown through.
double fly_speed(double scene_diagonal);

/// Moves in the plane of the film so that the point at `depth` (along the axis) that was under `from` comes to be under
/// `to`. `aspect` is the film's width over its height.
void pan(Camera& camera, const glm::dvec2& from, const glm::dvec2& to, double aspect, double depth);

/// Multiplies the distance to `pivot` by `factor` > 0, never below a millionth of `scene_diagonal`; an orthographic
/// camera's view height too.
void dolly(Camera& camera, const glm::dvec3& pivot, double factor, double scene_diagonal);

/// The point that a film point sees at `distance` from the camera (from the film's plane of an orthographic one), as
/// first-hit depth has it.
glm::dvec3 point_seen(const Camera& camera, const glm::dvec2& film, double aspect, double distance);

/// What the lens has in focus comes to lie in the plane of that point; false, and nothing done, where it is behind.
bool focus_on(Camera& camera, const glm::dvec3& point);

/// Vertical; kept between 1 and 150 degrees. An orthographic camera's view height changes as if it were perspective and
/// looked at `distance`.
void set_field_of_view(Camera& camera, double radians, double distance);

/// Distance along the axis to a point, at least `least`: the depth for pan.
double depth_of(const Camera& camera, const glm::dvec3& point, double least);

}  // namespace diptych::core::app
