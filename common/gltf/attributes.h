// Vertex attributes of one glTF primitive, checked and converted to float.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "gltf/document.h"

namespace diptych::core::gltf {

/// Raw vertex data; a vector is empty where the file has no such attribute. Joints and weights hold whole sets of four
/// a vertex.
struct Attributes {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec4> tangents;
    std::array<std::vector<glm::vec2>, 2> uvs;
    std::vector<glm::vec4> colors;
    std::vector<std::vector<glm::uvec4>> joints;
    std::vector<std::vector<glm::vec4>> weights;
};

/// Reads what `primitive` names, morph targets applied by `morph_weights`; joints and weights only where `skinned`.
/// `object` is the primitive's name in messages. Throws Error where an attribute's type is wrong, its data out of
/// bounds, or its count not that of POSITION, which must be there.
Attributes read_attributes(Document& document, const tinygltf::Primitive& primitive,
                           const std::vector<double>& morph_weights, bool skinned, const std::string& object);

}  // namespace diptych::core::gltf
