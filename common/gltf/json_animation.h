// Moving nodes and animations as glTF. For gltf/write.cpp.
#pragma once

#include "gltf/json.h"

#include <functional>

namespace diptych::core::gltf {

/// Numbers to an accessor of that many components each; times also want bounds.
using AddAccessor = std::function<int(const std::vector<float>& numbers, int components, bool with_bounds)>;

/// Name and placement of a node.
Json json_node(const Node& node);

/// Nodes of the scene stand in the file `first_node` later; materials and lights keep their indices. Records the
/// extensions that it uses.
Json json_animation(const Animation& animation, int first_node, const AddAccessor& add_accessor,
                    std::set<std::string>& extensions);

}  // namespace diptych::core::gltf
