// Triangles that lie exactly on others. Which of two a ray meets is up to the intersector, so one of them has to go.
#pragma once

#include <cstddef>
#include <vector>

#include "scene/scene.h"

namespace diptych::core {

/// Triangles to leave out of one primitive, in ascending order.
using LeftOut = std::vector<std::uint32_t>;

/// Triangles to leave out of a scene: for each primitive of a mesh.
struct DuplicateTriangles {
    std::vector<std::vector<LeftOut>> of_meshes;     // parallel to Scene::meshes; empty where a mesh has none
    std::vector<std::vector<LeftOut>> of_instances;  // parallel to Scene::instances, beside the mesh's; or empty
    std::size_t count = 0;                           // of all instances
};

/// Opaque triangles with the same vertices in the same cyclic order as one before them, in the order of instances,
/// primitives and triangles, that has the same transform: of the same instance, or of another that stands still.
DuplicateTriangles find_duplicate_triangles(const Scene& scene);

/// The mesh without them.
Mesh without_triangles(const Mesh& mesh, const std::vector<LeftOut>& left_out);

}  // namespace diptych::core
