#include "gltf/written_document.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <string_view>

namespace diptych::core::gltf {

int add_view(WrittenDocument& document, const void* data, std::size_t size, ViewTarget target) {
    auto& bytes = document.bytes;
    bytes.resize((bytes.size() + 3) / 4 * 4);
    Json view = {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", size}};
    if (target != no_target) {
        view["target"] = int(target);
    }
    const auto* first = static_cast<const char*>(data);
    bytes.insert(bytes.end(), first, first + size);
    return document.views.add(view);
}

int add_array(WrittenDocument& document, const void* data, std::size_t size, ViewTarget target, const Json& accessor) {
    const std::string_view content(static_cast<const char*>(data), size);
    const std::string kind = accessor.dump();
    const std::size_t hash = std::hash<std::string_view>{}(content);
    const auto [first, last] = document.arrays.equal_range(hash);
    for (auto it = first; it != last; ++it) {
        const StoredArray& stored = it->second;
        if (stored.kind == kind && stored.size == size &&
            std::memcmp(document.bytes.data() + stored.offset, data, size) == 0) {
            return stored.accessor;
        }
    }
    Json out = {{"bufferView", add_view(document, data, size, target)}};
    out.update(accessor);
    const int index = document.accessors.add(out);
    document.arrays.emplace(hash, StoredArray{index, document.bytes.size() - size, size, kind});
    return index;
}

int add_numbers(WrittenDocument& document, const std::vector<float>& numbers, int components, bool with_bounds) {
    const std::string type = components == 1 ? "SCALAR" : "VEC" + std::to_string(components);
    Json accessor = {
        {"componentType", int(type_float)}, {"count", numbers.size() / std::size_t(components)}, {"type", type}};
    if (with_bounds) {
        const auto [low, high] = std::minmax_element(numbers.begin(), numbers.end());
        accessor["min"] = Json::array({decimal(*low)});
        accessor["max"] = Json::array({decimal(*high)});
    }
    return add_array(document, numbers.data(), numbers.size() * sizeof(float), no_target, accessor);
}

int add_indices(WrittenDocument& document, const std::vector<glm::uvec3>& triangles, std::size_t vertices) {
    const std::size_t count = 3 * triangles.size();
    const bool is_short = vertices <= 65535;  // 65535 itself would restart a strip
    const Json accessor = {
        {"componentType", int(is_short ? type_uint16 : type_uint32)}, {"count", count}, {"type", "SCALAR"}};
    if (!is_short) {
        return add_array(document, triangles.data(), 4 * count, index_target, accessor);
    }
    std::vector<std::uint16_t> indices;
    indices.reserve(count);
    for (const glm::uvec3& t : triangles) {
        for (int i = 0; i < 3; ++i) {
            indices.push_back(std::uint16_t(t[i]));
        }
    }
    return add_array(document, indices.data(), 2 * count, index_target, accessor);
}

}  // namespace diptych::core::gltf
