// Irradiance from polygons, in double, by Lambert's formula: the closed form that renders are held against.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/scene.h"

namespace diptych::core::tests {

using Polygon = std::vector<glm::dvec3>;

/// The part of the polygon above the plane through the origin with this normal (Sutherland & Hodgman 1974).
inline Polygon clip_to_horizon(const Polygon& polygon, const glm::dvec3& normal) {
    Polygon out;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 a = polygon[i];
        const glm::dvec3 b = polygon[(i + 1) % polygon.size()];
        const double ha = glm::dot(a, normal);
        const double hb = glm::dot(b, normal);
        if (ha >= 0) {
            out.push_back(a);
        }
        if ((ha >= 0) != (hb >= 0)) {
            out.push_back(a + (b - a) * (ha / (ha - hb)));
        }
    }
    return out;
}

/// E / L at the origin, facing `normal`, from a polygon of radiance L that shines to both sides: half the sum over
/// edges of the angle times the cosine of the edge's plane.
inline double polygon_irradiance(const Polygon& polygon, const glm::dvec3& normal) {
    const Polygon p = clip_to_horizon(polygon, normal);
    double sum = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const glm::dvec3 a = glm::normalize(p[i]);
        const glm::dvec3 b = glm::normalize(p[(i + 1) % p.size()]);
        const glm::dvec3 axis = glm::cross(a, b);
        const double sine = glm::length(axis);
        if (sine > 0) {
            sum += std::atan2(sine, glm::dot(a, b)) * glm::dot(axis / sine, normal);
        }
    }
    return std::abs(sum) / 2;
}

/// E / L at the origin from the triangles of a convex mesh, moved by `shift`, whose front faces it.
inline double convex_irradiance(const Primitive& mesh, const glm::dvec3& shift, const glm::dvec3& normal) {
    double sum = 0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a = glm::dvec3(mesh.positions[t.x]) + shift;
        const glm::dvec3 b = glm::dvec3(mesh.positions[t.y]) + shift;
        const glm::dvec3 c = glm::dvec3(mesh.positions[t.z]) + shift;
        if (glm::dot(glm::cross(b - a, c - a), a) < 0) {
            sum += polygon_irradiance({a, b, c}, normal);
        }
    }
    return sum;
}

}  // namespace diptych::core::tests
