#include "pack/range.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "error.h"
#include "pack/linear_part.h"

namespace diptych::core {
namespace {

std::string metres(double length) {
    char text[40];
    std::snprintf(text, sizeof text, "%.3g m", length);
    return text;
}

}  // namespace

double reach_of(const MeshFrame& frame, const glm::dmat4& to_world, const glm::dvec3& origin) {
    double reach = 0;
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 side((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
        const glm::dvec3 packed = frame.middle + frame.spread.axes * (side * frame.spread.half);
        const glm::dvec3 corner = frame.center + frame.unit * packed;
        const glm::dvec3 from_origin = glm::dvec3(to_world * glm::dvec4(corner, 1)) - origin;
        const double distance = std::hypot(from_origin.x, from_origin.y, from_origin.z);
        reach = distance <= reach ? reach : distance;  // NaN stays
    }
    return reach;
}

double sizes_away(const MeshFrame& frame, const glm::dmat4& to_world, const glm::dvec3& origin) {
    const glm::dvec3& half = frame.spread.half;
    const double size = largest_column(glm::dmat3(to_world)) * frame.unit * std::max({half.x, half.y, half.z});
    const glm::dvec3 middle = frame.center + frame.unit * frame.middle;
    return glm::length(glm::dvec3(to_world * glm::dvec4(middle, 1)) - origin) / size;
}

double scene_reach(const Scene& scene, const std::vector<PlannedMesh>& meshes, const glm::dvec3& origin) {
    double reach = 1;
    for (const Instance& instance : scene.instances) {
        const MeshFrame& frame = meshes[static_cast<std::size_t>(instance.mesh)].frame;
        const double own = reach_of(frame, instance.object_to_world, origin);
        require_near(scene, "instance '" + instance.name + "'", "reaches", own);
        reach = std::max(reach, own);
    }
    return reach;
}

void require_near(const Scene& scene, const std::string& object, const char* what, double distance) {
    if (!(distance <= farthest)) {
        throw Error(scene.name + ": " + object + ": " + what + " " + metres(distance) + " from the camera, more than " +
                    metres(farthest) + ", which single precision can render: scale the scene down");
    }
}

void require_camera(const Scene& scene, const Camera& camera, const glm::dvec2& half_film, const PackedScene& packed) {
    const double distance = glm::length(glm::dvec3(camera.camera_to_world[3]) - packed.origin);
    const double film = std::max(half_film.x, half_film.y);
    const double lens = camera.lens.radius;
    const auto require = [&](const char* what, double size, double most) {
        if (!(size >= 0 && size <= most)) {
            throw Error(scene.name + ": camera '" + camera.name + "': " + what + " " + metres(size) +
                        ", and single precision can render up to " + metres(most));
        }
    };
    // Where its rays start in a mesh's own space, Embree wants fewer than 1.8e18 units.
    require("stands away from the scene's first view by", distance, std::min(farthest, 1e17 * packed.least_unit));
    require("has a lens of radius", lens, std::min(farthest, 1e17 * packed.least_unit));
    require("is focused at", lens > 0 ? camera.lens.focus_distance : 0, farthest);
    if (camera.orthographic) {
        require("has a view of half width", film, std::min(farthest, 1e17 * packed.least_unit));
    } else {
        require("has a field of view that spans, one metre away, half a width of", film, farthest);
    }
}

}  // namespace diptych::core
