// The node hierarchy of a glTF file.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/animation.h"
#include "gltf/document.h"

namespace diptych::core::gltf {

struct NodeTree {
    std::vector<Node> nodes;           // every node of the file, at rest; parents are the file's indices
    std::vector<glm::dmat4> to_world;  // for every node of the file
    std::vector<int> visible;          // the nodes of the scene to render, parents before children
    std::vector<int> carrying;         // these and all their ancestors, parents before children
};

/// Walks the default scene, else the first, else all root nodes. A scene may list a node that has a parent: the node
/// keeps its place under all of its ancestors, and is drawn once (docs/decisions/0017-leniency.md). Throws Error where
/// an index points nowhere, a node has two parents or is its own ancestor, or a transform is not finite.
NodeTree read_nodes(Document& document);

/// "nodes[3] (name)".
std::string node_label(const Document& document, int node);

/// What pose.h's rigid_placement or light_placement found for this node. Throws Error where that is nothing.
glm::dmat4 require_direction(const Document& document, const std::optional<glm::dmat4>& placed, int node);

}  // namespace diptych::core::gltf
