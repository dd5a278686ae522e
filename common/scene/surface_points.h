// Points on a scene's surfaces, for estimates that are made once, before anything is packed: what a camera sees, and
// where light is emitted. The same scene always gives the same points.
#pragma once

#include <vector>

#include "scene/scene.h"

namespace diptych::core {

struct SurfacePoint {
    glm::dvec3 position;  // world space
    glm::dvec3 normal;    // unit, geometric
    int material = none;
    double emission = 0;     // luminance of the radiance emitted to the normal's side, textures included
    bool two_sided = false;  // emits to the other side too
    double area = 0;         // of an emitter: of the surface that the point stands for
};

/// Radiance that each material emits before textures, at the brightest moment of its animations.
std::vector<glm::dvec3> peak_emissions(const Scene& scene);

/// About `count` points on the surfaces that emit, as dense as their peak emission is bright. None where nothing emits.
std::vector<SurfacePoint> emitting_points(const Scene& scene, const std::vector<glm::dvec3>& peaks, int count);

/// The points that the camera sees at the centres of side x side pixels, normals towards it; fewer where it sees past
/// the scene. A texel that is cut out or more transparent than not is looked through.
std::vector<SurfacePoint> seen_points(const Scene& scene, const std::vector<glm::dvec3>& peaks, const Camera& camera,
                                      int side);

/// A point of a triangle by the barycentric weights of its corners, read as the nearest texel.
double emission_at(const Scene& scene, const glm::dvec3& peak, const Primitive& primitive, const glm::uvec3& triangle,
                   const glm::dvec3& weights);
bool covered_at(const Scene& scene, const Primitive& primitive, const glm::uvec3& triangle, const glm::dvec3& weights);

}  // namespace diptych::core
