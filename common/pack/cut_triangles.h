// Large triangles near the eye, in smaller ones.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>

#include "scene/scene.h"

namespace diptych::core {

/// A place on a triangle is known to an ulp of the triangle's size, and rays leave it by a few of those (ray_offset.h).
/// So that neither is seen, no edge may be longer than this, as a multiple of the eye's distance to the triangle: 0.25
/// mm a metre.
inline constexpr double longest_near_edge = 1024;

/// Triangles that may be added to a scene by cutting.
inline constexpr std::size_t most_cut_triangles = std::size_t{1} << 20U;

/// The mesh with every triangle halved across its longest edge, and its neighbours with it, until none is larger than
/// that; vertices are relative to `eye`, so that those near it have the most digits. Attributes are interpolated as
/// they will be within triangles, normals not normalised, so the surface stays what it is. Nothing where no triangle is
/// so large.
///
/// `eye`: in the mesh's space. `object_to_world`: the linear part of where it stands. `budget`: triangles that may be
/// added, less those that were; cutting ends where it is used up.
std::optional<Mesh> cut_near_triangles(const Mesh& mesh, const glm::dvec3& eye, const glm::dmat3& object_to_world,
                                       std::size_t& budget);

}  // namespace diptych::core
