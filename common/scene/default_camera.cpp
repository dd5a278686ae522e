#include "scene/default_camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace diptych::core {
namespace {

void grow(Bounds& bounds, glm::dvec3 point) {
    bounds.lo = glm::min(bounds.lo, point);
    bounds.hi = glm::max(bounds.hi, point);
}

Bounds empty_bounds() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {glm::dvec3(infinity), glm::dvec3(-infinity)};
}

glm::dvec3 corner(const Bounds& bounds, int i) {
    return {i & 1 ? bounds.hi.x : bounds.lo.x, i & 2 ? bounds.hi.y : bounds.lo.y, i & 4 ? bounds.hi.z : bounds.lo.z};
}

template <typename Visit>
void each_used_vertex(const Mesh& mesh, const Visit& visit) {
    for (const Primitive& primitive : mesh.primitives) {
        std::vector<bool> used(primitive.positions.size(), false);
        for (const glm::uvec3& triangle : primitive.triangles) {
            used[triangle.x] = used[triangle.y] = used[triangle.z] = true;
        }
        for (std::size_t i = 0; i < used.size(); ++i) {
            if (used[i]) {
                visit(glm::dvec3(primitive.positions[i]));
            }
        }
    }
}

// A box stays the tight box under a matrix that sends each axis to an axis.
bool keeps_axes(const glm::dmat4& matrix) {
    for (int column = 0; column < 3; ++column) {
        int nonzero = 0;
        for (int row = 0; row < 3; ++row) {
            nonzero += matrix[column][row] != 0 ? 1 : 0;
        }
        if (nonzero > 1) {
            return false;
        }
    }
    return true;
}

}  // namespace

bool is_empty(const Bounds& bounds) {
    return !(bounds.lo.x <= bounds.hi.x && bounds.lo.y <= bounds.hi.y && bounds.lo.z <= bounds.hi.z);
}

Bounds scene_bounds(const Scene& scene) {
    std::vector<Bounds> local(scene.meshes.size(), empty_bounds());
    for (std::size_t i = 0; i < local.size(); ++i) {
        each_used_vertex(scene.meshes[i], [&](glm::dvec3 p) { grow(local[i], p); });
    }
    Bounds bounds = empty_bounds();
    for (const Instance& instance : scene.instances) {
        const auto mesh = static_cast<std::size_t>(instance.mesh);
        if (is_empty(local[mesh])) {
            continue;
        }
        const auto add = [&](glm::dvec3 p) { grow(bounds, glm::dvec3(instance.object_to_world * glm::dvec4(p, 1))); };
        if (keeps_axes(instance.object_to_world)) {
            for (int i = 0; i < 8; ++i) {
                add(corner(local[mesh], i));
            }
        } else {
            each_used_vertex(scene.meshes[mesh], add);
        }
    }
    return bounds;
}

Camera frame_scene(const Scene& scene) {
    Bounds bounds = scene_bounds(scene);
    if (is_empty(bounds)) {
        bounds = {glm::dvec3(-0.5), glm::dvec3(0.5)};
    }
    const glm::dvec3 centre = 0.5 * bounds.lo + 0.5 * bounds.hi;
    const glm::dvec3 back = glm::normalize(glm::dvec3(0, 0.3, 1));
    const glm::dvec3 right(1, 0, 0);
    const glm::dvec3 up = glm::cross(back, right);
    Camera camera;
    camera.name = "(frames the scene)";
    camera.vertical_fov = std::numbers::pi / 4;
    const double slope = std::tan(camera.vertical_fov / 2);
    double distance = 0;
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 offset = corner(bounds, i) - centre;
        const double reach = std::max(std::abs(glm::dot(offset, right)), std::abs(glm::dot(offset, up)));
        distance = std::max(distance, glm::dot(offset, back) + reach / slope);
    }
    distance *= 1.05;
    if (!(distance > 0)) {
        distance = 3;
    }
    // Far from the origin a double still has to tell the camera from what it looks at.
    distance = std::max(distance, 1e-9 * glm::length(centre));
    camera.camera_to_world[0] = glm::dvec4(right, 0);
    camera.camera_to_world[1] = glm::dvec4(up, 0);
    camera.camera_to_world[2] = glm::dvec4(back, 0);
    camera.camera_to_world[3] = glm::dvec4(centre + distance * back, 1);
    camera.lens.focus_distance = distance;
    return camera;
}

}  // namespace diptych::core
