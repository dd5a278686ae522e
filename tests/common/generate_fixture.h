// What the tests of generated scenes share: a folder that goes away, whole files, geometry in world space.
#pragma once

#include "generate/generate.h"
#include "temporary_folder.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <unistd.h>
#include <vector>

namespace diptych::core::generate_tests {

using tests::TemporaryFolder;

inline std::string file_bytes(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

struct WorldTriangle {
    glm::dvec3 a, b, c;
    const Material* material;

    glm::dvec3 area_vector() const { return 0.5 * glm::cross(b - a, c - a); }
    glm::dvec3 center() const { return (a + b + c) / 3.0; }
};

/// The triangles of one instance.
inline std::vector<WorldTriangle> world_triangles(const Scene& scene, const Instance& instance) {
    std::vector<WorldTriangle> out;
    for (const Primitive& primitive : scene.meshes.at(std::size_t(instance.mesh)).primitives) {
        const Material& material = scene.materials.at(std::size_t(primitive.material));
        for (const glm::uvec3& t : primitive.triangles) {
            const auto corner = [&](int i) {
                return glm::dvec3(instance.object_to_world * glm::dvec4(primitive.positions.at(t[i]), 1));
            };
            out.push_back({corner(0), corner(1), corner(2), &material});
        }
    }
    return out;
}

inline const Instance& find_instance(const Scene& scene, const std::string& name) {
    for (const Instance& instance : scene.instances) {
        if (instance.name == name) {
            return instance;
        }
    }
    throw std::runtime_error("no instance is called " + name);
}

}  // namespace diptych::core::generate_tests
