// Tangent frames for normal maps where the file gives none.
#pragma once

#include "scene/scene.h"

namespace diptych::core {

/// Replaces a primitive's tangents by ones derived for each vertex from positions, normals and the texture coordinates
/// that `slot` reads (its transform included): the mean of the adjacent triangles' directions of growing u, weighted by
/// angle, made orthogonal to the normal. w is +1 where cross(normal, tangent) points against growing v, that is up in
/// the image. A vertex without a usable direction gets any orthonormal tangent. A primitive without normals is first
/// taken apart into single triangles with flat normals, as glTF 2.0 (section 3.7.2.1) wants.
void derive_tangents(Primitive& primitive, const TextureSlot& slot);

/// A unit vector orthogonal to the unit vector `normal`.
glm::vec3 any_orthogonal(glm::vec3 normal);

}  // namespace diptych::core
