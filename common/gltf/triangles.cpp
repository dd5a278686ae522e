#include "gltf/triangles.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "gltf/accessor.h"
#include "gltf/tangents.h"

namespace diptych::core::gltf {
namespace {

template <typename Vector>
bool is_finite(const Vector& v) {
    for (int c = 0; c < Vector::length(); ++c) {
        if (!std::isfinite(v[c])) {
            return false;
        }
    }
    return true;
}

/// Exactly: two vertices in one place, or all on a line.
bool has_no_area(const std::vector<glm::vec3>& positions, const glm::uvec3& t) {
    const glm::dvec3 a(positions[t.x]);
    return glm::cross(glm::dvec3(positions[t.y]) - a, glm::dvec3(positions[t.z]) - a) == glm::dvec3(0);
}

void drop_bad_triangles(Document& document, Primitive& primitive, const std::string& object) {
    std::vector<glm::vec3>& positions = primitive.positions;
    const auto good = std::find_if(positions.begin(), positions.end(), is_finite<glm::vec3>);
    const auto bad = [&](const glm::uvec3& t) {
        return !is_finite(positions[t.x]) || !is_finite(positions[t.y]) || !is_finite(positions[t.z]);
    };
    const auto kept = std::remove_if(primitive.triangles.begin(), primitive.triangles.end(), bad);
    const auto dropped = static_cast<std::size_t>(primitive.triangles.end() - kept);
    primitive.triangles.erase(kept, primitive.triangles.end());
    warn_amount(document, object, dropped, "triangles have a vertex that is not finite; dropped");
    const auto flat = std::remove_if(primitive.triangles.begin(), primitive.triangles.end(),
                                     [&](const glm::uvec3& t) { return has_no_area(positions, t); });
    const auto flat_count = static_cast<std::size_t>(primitive.triangles.end() - flat);
    primitive.triangles.erase(flat, primitive.triangles.end());
    warn_amount(document, object, flat_count, "triangles have no area; dropped");
    if (good != positions.end()) {
        std::replace_if(
            positions.begin(), positions.end(), [](glm::vec3 p) { return !is_finite(p); }, glm::vec3(*good));
    }
}

bool normalize_in_place(glm::vec3& v) {
    const glm::dvec3 wide(v);
    const double length = glm::length(wide);
    if (!std::isfinite(length) || length < 1e-20) {
        return false;
    }
    v = glm::vec3(wide / length);
    return true;
}

std::vector<glm::dvec3> face_normal_sums(const Primitive& primitive) {
    std::vector<glm::dvec3> sums(primitive.positions.size(), glm::dvec3(0));
    for (const glm::uvec3& t : primitive.triangles) {
        const glm::dvec3 a(primitive.positions[t.x]);
        const glm::dvec3 normal =
            glm::cross(glm::dvec3(primitive.positions[t.y]) - a, glm::dvec3(primitive.positions[t.z]) - a);
        for (int k = 0; k < 3; ++k) {
            sums[t[k]] += normal;
        }
    }
    return sums;
}

void clean_normals(Document& document, Primitive& primitive, const std::string& object) {
    std::vector<std::size_t> bad;
    for (std::size_t i = 0; i < primitive.normals.size(); ++i) {
        if (!normalize_in_place(primitive.normals[i])) {
            bad.push_back(i);
        }
    }
    if (bad.empty()) {
        return;
    }
    warn_amount(document, object, bad.size(), "normals have no direction; replaced by their faces'");
    const std::vector<glm::dvec3> sums = face_normal_sums(primitive);
    for (const std::size_t i : bad) {
        const double length = glm::length(sums[i]);
        primitive.normals[i] = length > 0 && std::isfinite(length) ? glm::vec3(sums[i] / length) : glm::vec3(0, 0, 1);
    }
}

void clean_tangents(Document& document, Primitive& primitive, const std::string& object) {
    std::size_t bad = 0;
    for (std::size_t i = 0; i < primitive.tangents.size(); ++i) {
        glm::vec3 tangent(primitive.tangents[i]);
        if (!normalize_in_place(tangent)) {
            tangent = any_orthogonal(primitive.normals[i]);
            ++bad;
        }
        primitive.tangents[i] = glm::vec4(tangent, primitive.tangents[i].w < 0 ? -1 : 1);
    }
    warn_amount(document, object, bad, "tangents have no direction; replaced");
}

}  // namespace

std::vector<glm::uvec3> read_triangles(Document& document, const tinygltf::Primitive& primitive,
                                       std::size_t vertex_count, const std::string& object) {
    const int mode = primitive.mode;
    if (mode >= TINYGLTF_MODE_POINTS && mode <= TINYGLTF_MODE_LINE_STRIP) {
        warn(document, object, "points and lines are left out");
        return {};
    }
    if (mode < TINYGLTF_MODE_POINTS || mode > TINYGLTF_MODE_TRIANGLE_FAN) {
        fail(document, object + ".mode", "is " + std::to_string(mode) + ", which glTF 2.0 does not have");
    }
    std::vector<std::uint32_t> indices;
    if (primitive.indices != none) {
        indices = read_integers(document, primitive.indices, 1, object + ".indices");
    } else {
        indices.resize(vertex_count);
        std::iota(indices.begin(), indices.end(), 0U);
    }
    for (std::size_t i = 0; i < indices.size(); ++i) {
        if (indices[i] >= vertex_count) {
            fail(document, object + ".indices",
                 "index " + std::to_string(indices[i]) + " at " + std::to_string(i) + ", but there are " +
                     std::to_string(vertex_count) + " vertices");
        }
    }
    std::vector<glm::uvec3> triangles;
    if (mode == TINYGLTF_MODE_TRIANGLES) {
        if (indices.size() % 3 != 0) {
            warn(document, object, "the indices are no whole number of triangles; the rest is left out",
                 "there are " + std::to_string(indices.size()));
        }
        triangles.reserve(indices.size() / 3);
        for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
            triangles.emplace_back(indices[i], indices[i + 1], indices[i + 2]);
        }
        return triangles;
    }
    for (std::size_t i = 0; i + 2 < indices.size(); ++i) {
        if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
            triangles.emplace_back(indices[i + 1], indices[i + 2], indices[0]);
        } else {
            triangles.emplace_back(indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2]);
        }
    }
    return triangles;
}

void clean_primitive(Document& document, Primitive& primitive, const std::string& object) {
    drop_bad_triangles(document, primitive, object);
    clean_normals(document, primitive, object);
    clean_tangents(document, primitive, object);
    std::size_t bad_uvs = 0;
    for (std::vector<glm::vec2>& uvs : primitive.uvs) {
        for (glm::vec2& uv : uvs) {
            if (!is_finite(uv)) {
                uv = glm::vec2(0);
                ++bad_uvs;
            }
        }
    }
    warn_amount(document, object, bad_uvs, "texture coordinates are not finite; set to 0");
    std::size_t bad_colors = 0;
    for (glm::vec4& color : primitive.colors) {
        const glm::vec4 clean = is_finite(color) ? glm::clamp(color, 0.0F, 1.0F) : glm::vec4(1);
        bad_colors += clean != color ? 1 : 0;
        color = clean;
    }
    warn_amount(document, object, bad_colors, "vertex colours are out of range; clamped");
}

}  // namespace diptych::core::gltf
