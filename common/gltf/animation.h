// Animations of a glTF file: keyframes of nodes, and of emissions and light intensities by KHR_animation_pointer.
#pragma once

#include <vector>

#include "gltf/document.h"
#include "gltf/nodes.h"
#include "scene/scene.h"

namespace diptych::core::gltf {

/// What moves, in the file's indices, and where its nodes went.
struct Motion {
    std::vector<Animation> animations;  // targets are the file's nodes, materials and lights
    std::vector<int> scene_nodes;       // for every node of the file: its place in Scene::nodes, or none
    std::vector<bool> moving;           // for every node of the file: it or an ancestor is animated

    /// Scene::nodes index of a node that moves, else none.
    int node(int file_node) const {
        return moving[static_cast<std::size_t>(file_node)] ? scene_nodes[static_cast<std::size_t>(file_node)] : none;
    }
};

/// Reads the animations and fills Scene::nodes with what of the scene's nodes they move, and the ancestors of that.
/// What cannot be played (morph weights, skins, other pointers) is left out with one warning a kind; faults of
/// keyframes go into Animation::warnings. Throws Error naming animation and channel where their data cannot be read.
Motion read_motion(Document& document, const NodeTree& tree, Scene& scene);

/// Fills Scene::animations once everything else is there, and marks what they change. `light_sources` holds for each of
/// the scene's lights the file's.
void attach_motion(Document& document, const Motion& motion, const std::vector<int>& light_sources, Scene& scene);

}  // namespace diptych::core::gltf
