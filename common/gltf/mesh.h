// Meshes of a glTF file: attributes, triangles, morph targets and skins baked in.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "gltf/document.h"
#include "scene/scene.h"

namespace diptych::core::gltf {

/// What sets one use of a mesh apart from another.
struct MeshUse {
    std::vector<double> weights;     // of the morph targets; missing ones are 0
    std::vector<glm::dmat4> joints;  // joint to world, inverse bind matrix included; empty where there is no skin
};

/// Reads meshes[index] as `use` deforms it. Primitives without triangles or positions are left out with a warning.
/// Throws Error where data lies out of bounds or counts disagree. A default material is appended to the scene on first
/// need.
Mesh import_mesh(Document& document, Scene& scene, int index, const MeshUse& use);

}  // namespace diptych::core::gltf
