// How large and how small a scene may be: what fp32 holds the squares and products of. The same for every backend.
#pragma once

#include <glm/glm.hpp>

#include "pack/mesh_plan.h"

namespace diptych::core {

/// No vertex, light or camera may be farther from the first camera, metres: the product of three edges is a volume.
inline constexpr double farthest = 1e12;
/// What is smaller is a point: left out where it cannot be seen from the camera, else refused. Metres.
inline constexpr double smallest = 1e-14;

/// How far from `origin` a mesh of this frame reaches under this transform, by the box of its spread. Infinite or NaN
/// where it does.
double reach_of(const MeshFrame& frame, const glm::dmat4& to_world, const glm::dvec3& origin);

/// How many of its own sizes a mesh of this frame is away from `origin` under this transform; the size is at least that
/// of its longest half axis.
double sizes_away(const MeshFrame& frame, const glm::dmat4& to_world, const glm::dvec3& origin);

/// The largest distance of any instance; at least 1. Throws Error naming the instance beyond `farthest`.
double scene_reach(const Scene& scene, const std::vector<PlannedMesh>& meshes, const glm::dvec3& origin);

/// Throws Error unless 0 <= distance <= `farthest`. `object` as in "camera 'main'", `what` as in "stands".
void require_near(const Scene& scene, const std::string& object, const char* what, double distance);

/// Throws Error where the camera, its lens or its film, of that half width and height, is out of range.
void require_camera(const Scene& scene, const Camera& camera, const glm::dvec2& half_film, const PackedScene& packed);

}  // namespace diptych::core
