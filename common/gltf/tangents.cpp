#include "gltf/tangents.h"

#include <algorithm>
#include <cmath>

namespace diptych::core {
namespace {

template <typename T>
void take_apart(std::vector<T>& values, const std::vector<glm::uvec3>& triangles) {
    if (values.empty()) {
        return;
    }
    std::vector<T> single;
    single.reserve(triangles.size() * 3);
    for (const glm::uvec3& triangle : triangles) {
        for (int k = 0; k < 3; ++k) {
            single.push_back(values[triangle[k]]);
        }
    }
    values = std::move(single);
}

void flatten(Primitive& primitive) {
    take_apart(primitive.positions, primitive.triangles);
    take_apart(primitive.colors, primitive.triangles);
    for (std::vector<glm::vec2>& uvs : primitive.uvs) {
        take_apart(uvs, primitive.triangles);
    }
    primitive.normals.reserve(primitive.positions.size());
    for (std::uint32_t i = 0; i < primitive.triangles.size(); ++i) {
        primitive.triangles[i] = glm::uvec3(3 * i, 3 * i + 1, 3 * i + 2);
        const glm::dvec3 a(primitive.positions[3 * i]);
        const glm::dvec3 normal =
            glm::cross(glm::dvec3(primitive.positions[3 * i + 1]) - a, glm::dvec3(primitive.positions[3 * i + 2]) - a);
        const double length = glm::length(normal);
        const glm::vec3 unit = length > 0 && std::isfinite(length) ? glm::vec3(normal / length) : glm::vec3(0, 0, 1);
        primitive.normals.insert(primitive.normals.end(), 3, unit);
    }
}

struct Frame {
    glm::dvec3 along_u{0};
    glm::dvec3 along_v{0};
};

double angle_between(glm::dvec3 a, glm::dvec3 b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

bool has_length(glm::dvec3 v) {
    const double length = glm::length(v);
    return length > 0 && std::isfinite(length);
}

void add_triangle(const Primitive& primitive, glm::uvec3 triangle, const std::vector<glm::dvec2>& uvs,
                  std::vector<Frame>& frames) {
    glm::dvec3 p[3];
    for (int k = 0; k < 3; ++k) {
        p[k] = glm::dvec3(primitive.positions[triangle[k]]);
    }
    const glm::dvec2 e1 = uvs[triangle[1]] - uvs[triangle[0]];
    const glm::dvec2 e2 = uvs[triangle[2]] - uvs[triangle[0]];
    const double area = e1.x * e2.y - e1.y * e2.x;
    if (area == 0 || !std::isfinite(area)) {
        return;
    }
    const double sign = area > 0 ? 1 : -1;
    const glm::dvec3 along_u = sign * (e2.y * (p[1] - p[0]) - e1.y * (p[2] - p[0]));
    const glm::dvec3 along_v = sign * (e1.x * (p[2] - p[0]) - e2.x * (p[1] - p[0]));
    if (!has_length(along_u) || !has_length(along_v)) {
        return;
    }
    for (int k = 0; k < 3; ++k) {
        const double angle = angle_between(p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
        frames[triangle[k]].along_u += angle * glm::normalize(along_u);
        frames[triangle[k]].along_v += angle * glm::normalize(along_v);
    }
}

glm::vec4 tangent_of(const Frame& frame, glm::dvec3 normal) {
    const glm::dvec3 projected = frame.along_u - normal * glm::dot(normal, frame.along_u);
    if (!(glm::length(projected) > 1e-6 * glm::length(frame.along_u))) {
        return {any_orthogonal(glm::vec3(normal)), 1};
    }
    const glm::dvec3 tangent = glm::normalize(projected);
    const double up = -glm::dot(glm::cross(normal, tangent), frame.along_v);
    return {glm::vec3(tangent), up < 0 ? -1.0F : 1.0F};
}

}  // namespace

glm::vec3 any_orthogonal(glm::vec3 normal) {
    // Crossing with the axis furthest away keeps the length well above zero.
    const glm::vec3 a = glm::abs(normal);
    const glm::vec3 axis = a.x <= a.y && a.x <= a.z ? glm::vec3(1, 0, 0)
                           : a.y <= a.z             ? glm::vec3(0, 1, 0)
                                                    : glm::vec3(0, 0, 1);
    return glm::normalize(glm::cross(normal, axis));
}

void derive_tangents(Primitive& primitive, const TextureSlot& slot) {
    if (primitive.normals.empty()) {
        flatten(primitive);
    }
    const std::vector<glm::vec2>& given = primitive.uvs[static_cast<std::size_t>(slot.uv_set)];
    std::vector<glm::dvec2> uvs(primitive.positions.size(), glm::dvec2(0));
    std::transform(given.begin(), given.end(), uvs.begin(), [&](glm::vec2 uv) {
        const glm::dvec3 extended(uv, 1);
        return glm::dvec2(glm::dot(glm::dvec3(slot.u_row), extended), glm::dot(glm::dvec3(slot.v_row), extended));
    });
    std::vector<Frame> frames(primitive.positions.size());
    for (const glm::uvec3& triangle : primitive.triangles) {
        add_triangle(primitive, triangle, uvs, frames);
    }
    primitive.tangents.resize(primitive.positions.size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
        primitive.tangents[i] = tangent_of(frames[i], glm::dvec3(primitive.normals[i]));
    }
}

}  // namespace diptych::core
