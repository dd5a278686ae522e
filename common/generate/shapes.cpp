#include "generate/shapes.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace diptych::core {

void add_quad(Primitive& primitive, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d) {
    const auto first = static_cast<std::uint32_t>(primitive.positions.size());
    primitive.positions.insert(primitive.positions.end(), {a, b, c, d});
    primitive.triangles.push_back({first, first + 1, first + 2});
    primitive.triangles.push_back({first, first + 2, first + 3});
}

void add_box(Primitive& primitive, const glm::vec3& low, const glm::vec3& high) {
    const auto corner = [&](int x, int y, int z) {
        return glm::vec3(x != 0 ? high.x : low.x, y != 0 ? high.y : low.y, z != 0 ? high.z : low.z);
    };
    add_quad(primitive, corner(0, 0, 0), corner(0, 0, 1), corner(0, 1, 1), corner(0, 1, 0));
    add_quad(primitive, corner(1, 0, 0), corner(1, 1, 0), corner(1, 1, 1), corner(1, 0, 1));
    add_quad(primitive, corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1));
    add_quad(primitive, corner(0, 1, 0), corner(0, 1, 1), corner(1, 1, 1), corner(1, 1, 0));
    add_quad(primitive, corner(0, 0, 0), corner(0, 1, 0), corner(1, 1, 0), corner(1, 0, 0));
    add_quad(primitive, corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1));
}

Primitive make_sphere(float radius, int segments, int rings, int material) {
    Primitive out;
    out.material = material;
    const auto add_vertex = [&](double polar, double azimuth) {
        const glm::vec3 n(std::sin(polar) * std::cos(azimuth), std::cos(polar), -std::sin(polar) * std::sin(azimuth));
        out.normals.push_back(n);
        out.positions.push_back(radius * n);
    };
    add_vertex(0, 0);
    for (int ring = 1; ring < rings; ++ring) {
        for (int i = 0; i < segments; ++i) {
            add_vertex(glm::pi<double>() * ring / rings, glm::two_pi<double>() * i / segments);
        }
    }
    out.normals.push_back({0, -1, 0});
    out.positions.push_back({0, -radius, 0});

    const auto at = [&](int ring, int i) { return std::uint32_t(1 + (ring - 1) * segments + i % segments); };
    const auto last = static_cast<std::uint32_t>(out.positions.size() - 1);
    for (int i = 0; i < segments; ++i) {
        out.triangles.push_back({0, at(1, i), at(1, i + 1)});
        for (int ring = 1; ring + 1 < rings; ++ring) {
            out.triangles.push_back({at(ring, i), at(ring + 1, i), at(ring + 1, i + 1)});
            out.triangles.push_back({at(ring, i), at(ring + 1, i + 1), at(ring, i + 1)});
        }
        out.triangles.push_back({at(rings - 1, i), last, at(rings - 1, i + 1)});
    }
    return out;
}

Primitive make_lathe(std::span<const glm::vec2> profile, int segments, int material) {
    Primitive out;
    out.material = material;
    for (std::size_t band = 0; band + 1 < profile.size(); ++band) {
        const glm::vec2 low = profile[band], high = profile[band + 1];
        const glm::vec2 slope = glm::normalize(glm::vec2(high.y - low.y, low.x - high.x));
        const auto first = static_cast<std::uint32_t>(out.positions.size());
        for (int i = 0; i < segments; ++i) {
            const double angle = glm::two_pi<double>() * i / segments;
            const auto c = float(std::cos(angle)), s = float(-std::sin(angle));
            for (const glm::vec2& point : {low, high}) {
                out.positions.push_back({point.x * c, point.y, point.x * s});
                out.normals.push_back({slope.x * c, slope.y, slope.x * s});
            }
        }
        for (int i = 0; i < segments; ++i) {
            const std::uint32_t here = first + 2 * std::uint32_t(i),
                                next = first + 2 * std::uint32_t((i + 1) % segments);
            if (low.x > 0) {
                out.triangles.push_back({here, next, next + 1});
            }
            if (high.x > 0) {
                out.triangles.push_back({here, next + 1, here + 1});
            }
        }
    }
    return out;
}

Material make_material(std::string name, const glm::vec3& base_color, float metallic, float roughness) {
    Material out;
    out.name = std::move(name);
    out.base_color = glm::vec4(base_color, 1);
    out.metallic = metallic;
    out.roughness = roughness;
    return out;
}

Material make_emitter(std::string name, const glm::vec3& radiance) {
    Material out = make_material(std::move(name), glm::vec3(0), 0, 1);
    out.specular = 0;
    out.emission = radiance;
    return out;
}

int add_material(Scene& scene, Material material) {
    scene.materials.push_back(std::move(material));
    return int(scene.materials.size()) - 1;
}

int add_mesh(Scene& scene, std::string name, std::vector<Primitive> primitives) {
    scene.meshes.push_back({std::move(name), std::move(primitives)});
    return int(scene.meshes.size()) - 1;
}

void add_instance(Scene& scene, std::string name, int mesh, const glm::dmat4& object_to_world) {
    scene.instances.push_back({std::move(name), mesh, object_to_world});
}

void add_object(Scene& scene, const std::string& name, std::vector<Primitive> primitives,
                const glm::dmat4& object_to_world) {
    add_instance(scene, name, add_mesh(scene, name, std::move(primitives)), object_to_world);
}

glm::dmat4 translation(double x, double y, double z) {
    glm::dmat4 out(1);
    out[3] = {x, y, z, 1};
    return out;
}

Camera make_camera(std::string name, const glm::dvec3& eye, const glm::dvec3& target, double vertical_fov) {
    const glm::dvec3 backward = glm::normalize(eye - target);
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), backward));
    Camera out;
    out.name = std::move(name);
    out.camera_to_world = glm::dmat4(glm::dvec4(right, 0), glm::dvec4(glm::cross(backward, right), 0),
                                     glm::dvec4(backward, 0), glm::dvec4(eye, 1));
    out.vertical_fov = glm::radians(vertical_fov);
    return out;
}

}  // namespace diptych::core
