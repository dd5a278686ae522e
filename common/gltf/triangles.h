// From a glTF primitive's indices and mode to plain triangles, and from any floats to finite ones.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "gltf/document.h"
#include "scene/scene.h"

namespace diptych::core::gltf {

/// The triangles of a primitive of `vertex_count` vertices: indexed or not, TRIANGLES, TRIANGLE_STRIP or TRIANGLE_FAN
/// (winding as in glTF 2.0, section 3.7.2.1). None, with a warning, for points and lines. Throws Error where an index
/// is no vertex.
std::vector<glm::uvec3> read_triangles(Document& document, const tinygltf::Primitive& primitive,
                                       std::size_t vertex_count, const std::string& object);

/// Makes all attributes finite: triangles with a vertex whose position is not, and those without area, are dropped;
/// normals and tangents become unit vectors, a useless normal that of the adjacent faces; other values fall back to
/// their neutral ones; colours are clamped to [0, 1]. One warning for each kind of change, with its count.
void clean_primitive(Document& document, Primitive& primitive, const std::string& object);

}  // namespace diptych::core::gltf
