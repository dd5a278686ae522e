// A scene at a moment of its animations.
#pragma once

#include "scene/scene.h"

namespace diptych::core {

/// Whether any animation that plays (clips.h) changes it over time.
bool moves(const Scene& scene);

/// Seconds from 0 to the last key of any animation that plays.
double duration(const Scene& scene);

/// Puts everything that an animation moves where it is at `seconds`: nodes, and with them instances, cameras and
/// lights; emissions and intensities, cut at 0 from below. All channels that play do so together; where two set the
/// same property, the later one wins. Indices and counts stay as they are. What nothing moves stays at rest, and
/// depends on no earlier pose. Throws Error where a camera or light is left without a direction, or a transform is not finite.
void pose_scene(Scene& scene, double seconds);

/// One of the cameras at that moment, the scene left as it is. Throws Error likewise.
Camera camera_at(const Scene& scene, std::size_t camera, double seconds);

/// `matrix` without scale, shear and mirroring: its -Z is kept exactly, +Y as far as that allows. Nothing where either
/// axis has length 0.
std::optional<glm::dmat4> rigid_part(const glm::dmat4& matrix);

/// Where a camera or a light of this node stands and looks. Scale does not turn it, and one of 0 does not either: the
/// direction is then that of the nodes' rotations. `to_world` of the node. Nothing where a
/// node's matrix leaves no direction.
std::optional<glm::dmat4> rigid_placement(const std::vector<Node>& nodes, int node, const glm::dmat4& to_world);

/// That of a light: a point light needs no direction.
std::optional<glm::dmat4> light_placement(PunctualType type, const std::vector<Node>& nodes, int node,
                                          const glm::dmat4& to_world);

}  // namespace diptych::core
