// Which meshes are packed, and where their vertices are: as the file has them, or in the world already.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pack/packed_scene.h"

namespace diptych::core {

/// The corners of a box; empty where low is above high.
struct Box {
    glm::dvec3 low{1e300};
    glm::dvec3 high{-1e300};
};

/// Around the vertices that triangles use.
Box box_of(const Mesh& mesh);

struct PlannedMesh {
    const Mesh* mesh = nullptr;
    std::shared_ptr<const Mesh> own;  // what `mesh` points to, where that is not the scene's
    MeshFrame frame;
    bool cut = false;                // vertices of `mesh` are relative to the frame's center already
    std::vector<std::size_t> users;  // instances
};

struct MeshPlan {
    std::vector<PlannedMesh> meshes;  // first those of the scene, in their order
    std::vector<int> of_instances;    // index into `meshes`; none where the instance shows nothing and is left out
    double reach = 1;                 // scene_reach of range.h
    std::vector<std::string> warnings;
};

/// Whether fp32 carries rays from `distance` of the mesh's sizes away into its space and back.
bool has_good_inverse(const glm::dmat3& linear, double distance, double reach);

/// Duplicate triangles are left out. An instance that stands still under a matrix without a good inverse gets a mesh of
/// its own, transformed in double. `camera` may be null. Throws Error where the scene is out of range.
MeshPlan plan_meshes(const Scene& scene, const glm::dvec3& origin, const Camera* camera);

}  // namespace diptych::core
