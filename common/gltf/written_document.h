// A glTF document while it is written: its top-level arrays as text, its one buffer, and the arrays in that. For
// gltf/write.cpp.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "gltf/json.h"

namespace diptych::core::gltf {

/// A top-level array, kept as text, one element a line: a million nodes cost their characters, and files diff by
/// object.
struct JsonList {
    std::string text;
    int size = 0;

    int add(const Json& element) {
        text += size == 0 ? "\n  " : ",\n  ";
        text += element.dump();
        return size++;
    }
};

/// An accessor already written, for another that would hold the same.
struct StoredArray {
    int accessor;
    std::size_t offset, size;
    std::string kind;
};

struct WrittenDocument {
    std::vector<char> bytes;
    std::unordered_multimap<std::size_t, StoredArray> arrays;  // by the hash of their bytes
    JsonList accessors, views, images, samplers, textures, materials, meshes, cameras, lights, nodes, animations;
    std::string root_nodes;  // comma-separated indices
    std::set<std::string> extensions;
};

enum ViewTarget { no_target = 0, vertex_target = 34962, index_target = 34963 };
enum ComponentType { type_uint16 = 5123, type_uint32 = 5125, type_float = 5126 };

/// The bytes as a part of the buffer that begins at a multiple of four. Returns the index of the buffer view.
int add_view(WrittenDocument& document, const void* data, std::size_t size, ViewTarget target);

/// The accessor of an array; arrays of one content and kind share one. `accessor` lacks only its view.
int add_array(WrittenDocument& document, const void* data, std::size_t size, ViewTarget target, const Json& accessor);

/// The accessor of floats, `components` an element; of triangles' indices, in 16 bits where the vertices are few.
int add_numbers(WrittenDocument& document, const std::vector<float>& numbers, int components, bool with_bounds);
int add_indices(WrittenDocument& document, const std::vector<glm::uvec3>& triangles, std::size_t vertices);

/// The accessor of one vector a vertex.
template <typename Vector>
int add_attribute(WrittenDocument& document, const std::vector<Vector>& values, bool with_bounds) {
    Json accessor = {{"componentType", int(type_float)},
                     {"count", values.size()},
                     {"type", "VEC" + std::to_string(Vector::length())}};
    if (with_bounds) {
        Vector low = values.front(), high = values.front();
        for (const Vector& value : values) {
            low = glm::min(low, value);
            high = glm::max(high, value);
        }
        accessor["min"] = json_vector(low);
        accessor["max"] = json_vector(high);
    }
    return add_array(document, values.data(), values.size() * sizeof(Vector), vertex_target, accessor);
}

}  // namespace diptych::core::gltf
