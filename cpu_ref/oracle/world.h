// The logical scene as one list of triangles in the world, in double.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/scene.h"

namespace diptych::core::oracle {

using glm::dvec2;
using glm::dvec3;
using glm::dvec4;

/// One triangle of one instance. Positions are relative to World::origin, metres.
struct Triangle {
    dvec3 a;
    dvec3 b;
    dvec3 c;
    dvec3 ab;     // b - a
    dvec3 ac;     // c - a
    dvec3 front;  // unit normal of the side where vertices run counter-clockwise, a mirrored instance's flip undone
    glm::uvec3 vertex;  // in `primitive`
    const Primitive* primitive;
    const Material* material;
    unsigned frame;  // in World::frames
};

/// How one instance carries directions.
struct Frame {
    glm::dmat3 linear;   // of object_to_world: tangents
    glm::dmat3 normals;  // cofactors, turned about where the instance mirrors: the inverse transpose but for its length
    bool mirrored;       // the determinant is negative by more than rounding
};

/// A scene whose instances have been multiplied out. The scene must outlive it.
struct World {
    const Scene* scene;
    dvec3 origin;   // world position of our (0, 0, 0): the middle of the scene, so that a far scene keeps its digits
    double extent;  // half the diagonal of the triangles' box, metres
    std::vector<Frame> frames;
    std::vector<Triangle> triangles;  // those with an area
    bool has_alpha = false;           // some surface may be passed by rays
};

World make_world(const Scene& scene);

inline double area(const Triangle& triangle) {
    return 0.5 * glm::length(glm::cross(triangle.ab, triangle.ac));
}

/// The point with barycentrics (u, v) of b and c.
inline dvec3 point_on(const Triangle& triangle, dvec2 uv) {
    return triangle.a + uv.x * triangle.ab + uv.y * triangle.ac;
}

/// An attribute between the three vertices; `values` is not empty. An attribute that is equal at the three keeps its
/// value exactly, which weights that sum to 1 only up to rounding would not give.
template <typename T>
auto interpolate(const std::vector<T>& values, const Triangle& triangle, dvec2 uv) {
    using Double = glm::vec<T::length(), double>;
    const Double a(values[triangle.vertex.x]);
    return a + uv.x * (Double(values[triangle.vertex.y]) - a) + uv.y * (Double(values[triangle.vertex.z]) - a);
}

/// Between the values of four neighbours, fx of the way to the right and fy of the way down, in the same form.
template <typename T>
T bilinear(const T& top_left, const T& top_right, const T& bottom_left, const T& bottom_right, double fx, double fy) {
    const T top = top_left + fx * (top_right - top_left);
    const T bottom = bottom_left + fx * (bottom_right - bottom_left);
    return top + fy * (bottom - top);
}

}  // namespace diptych::core::oracle
