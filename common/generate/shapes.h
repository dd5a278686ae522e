// Shapes and shorthand for the generated scenes. Fronts are counter-clockwise; flat shapes carry no normals.
#pragma once

#include "scene/scene.h"

#include <span>
#include <string>

namespace diptych::core {

/// Two triangles a b c, a c d. The front is where a b c d runs counter-clockwise.
void add_quad(Primitive& primitive, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d);

/// The six faces of an axis-aligned box, fronts outside.
void add_box(Primitive& primitive, const glm::vec3& low, const glm::vec3& high);

/// A closed sphere around the origin with smooth normals; 2 segments (rings - 1) triangles.
Primitive make_sphere(float radius, int segments, int rings, int material);

/// A surface of revolution about +Y through (radius, height) points that run upwards, front outside, one flat band a
/// pair, smooth around the axis. Not capped.
Primitive make_lathe(std::span<const glm::vec2> profile, int segments, int material);

Material make_material(std::string name, const glm::vec3& base_color, float metallic, float roughness);
/// A black surface that emits `radiance`, W/(sr m^2), from its front.
Material make_emitter(std::string name, const glm::vec3& radiance);

int add_material(Scene& scene, Material material);
int add_mesh(Scene& scene, std::string name, std::vector<Primitive> primitives);
void add_instance(Scene& scene, std::string name, int mesh, const glm::dmat4& object_to_world = glm::dmat4(1));
/// A mesh and one instance of it under the same name.
void add_object(Scene& scene, const std::string& name, std::vector<Primitive> primitives,
                const glm::dmat4& object_to_world = glm::dmat4(1));

glm::dmat4 translation(double x, double y, double z);

/// Perspective, +Y up; `vertical_fov` in degrees.
Camera make_camera(std::string name, const glm::dvec3& eye, const glm::dvec3& target, double vertical_fov);

}  // namespace diptych::core
