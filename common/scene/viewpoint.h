// Any camera at any place.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "scene/scene.h"

namespace diptych::core {

/// What of a camera is another than the scene has it; empty changes nothing. World space of the file, metres.
struct Viewpoint {
    std::optional<glm::dvec3> eye;  // and look_at: one goes with the other
    std::optional<glm::dvec3> look_at;
    std::optional<glm::dvec3> up;       // +Y by default; goes with them
    std::optional<double> fov;          // degrees, vertical; perspective cameras
    std::optional<double> view_height;  // metres, of the whole view; orthographic cameras

    bool operator==(const Viewpoint&) const = default;
};

/// What of a camera's lens is another than the scene has it; empty changes nothing.
struct LensChoice {
    std::optional<double> radius;          // metres
    std::optional<double> focus_distance;  // metres
};

/// The camera's lens as chosen.
void place_lens(const LensChoice& lens, Camera& camera);

/// Puts the camera there; one that an animation moved hangs in nothing afterwards. Throws Error, naming the setting,
/// where eye and look_at are one point or `up` is parallel to the line between them, a part is missing, or the camera
/// is of the other kind.
void place_at(const Viewpoint& viewpoint, Camera& camera);

/// The viewpoint that puts a camera of the same kind where this one is, to rounding. It looks at
/// the point `distance` ahead.
Viewpoint viewpoint_of(const Camera& camera, double distance);

}  // namespace diptych::core
