// What a written glTF file says, read by nlohmann::json alone and written from the specification: the other side of a
// test of the import, which panels and oracle share. Knows what random scenes hold and nothing more.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "image/image_file.h"

namespace diptych::core::tests {

/// A member of so many numbers, or `fallback`.
template <int n>
glm::vec<n, double> vector_of(const nlohmann::json& parent, const char* key, glm::vec<n, double> fallback) {
    for (int i = 0; parent.contains(key) && i < n; ++i) {
        fallback[i] = parent.at(key).at(std::size_t(i));
    }
    return fallback;
}

struct FileVertex {
    glm::dvec3 position{0};
    std::optional<glm::dvec3> normal;
    std::optional<glm::dvec4> tangent;
    glm::dvec2 uv[2] = {};
    glm::dvec4 color{1};
};

/// In the world; tangents and normals are the object's.
struct FileTriangle {
    FileVertex vertices[3];
    glm::dmat3 to_world{1};
    nlohmann::json material;
};

/// What a ray along which nothing is refracted or reflected shows first, weighted by alpha.
struct FirstHitMeans {
    glm::dvec3 albedo{0};
    glm::dvec3 normal{0};
    double depth = 0;
};

class FileScene {
public:
    explicit FileScene(const std::filesystem::path& path);

    const nlohmann::json& document() const { return document_; }
    const std::vector<FileTriangle>& triangles() const { return triangles_; }

    /// The node of camera or light `index` in the world.
    glm::dmat4 camera_to_world(int index) const { return cameras_.at(std::size_t(index)); }
    glm::dmat4 light_to_world(int index) const { return lights_.at(std::size_t(index)); }

    /// Through a film point in [0, 1]², y down.
    FirstHitMeans first_hit(int camera, glm::dvec2 film, double aspect) const;

private:
    void add_node(const nlohmann::json& node, const glm::dmat4& parent);
    void add_primitive(const nlohmann::json& primitive, const glm::dmat4& to_world);
    double number(const nlohmann::json& accessor, std::size_t element, std::size_t component) const;
    glm::dvec4 texel(const nlohmann::json& slot, const FileVertex& at, bool srgb) const;
    glm::dvec4 base_color(const nlohmann::json& material, const FileVertex& at) const;
    glm::dvec3 normal(const FileTriangle& triangle, const FileVertex& at, const glm::dvec3& to_eye) const;

    nlohmann::json document_;
    std::vector<char> bytes_;
    std::vector<Image> images_;
    std::vector<FileTriangle> triangles_;
    std::vector<glm::dmat4> cameras_;
    std::vector<glm::dmat4> lights_;
};

}  // namespace diptych::core::tests
