#include "scene/orbit.h"

#include <cmath>
#include <numbers>

namespace diptych::core {

glm::dvec3 orbit_pivot(const Scene& scene, const Camera& camera) {
    return orbit_pivot(scene_bounds(scene), camera);
}

glm::dvec3 orbit_pivot(const Bounds& bounds, const Camera& camera) {
    const glm::dvec3 centre = is_empty(bounds) ? glm::dvec3(0) : 0.5 * bounds.lo + 0.5 * bounds.hi;
    const glm::dvec3 eye(camera.camera_to_world[3]);
    const glm::dvec3 forward = -glm::dvec3(camera.camera_to_world[2]);
    const double distance = glm::dot(centre - eye, forward);
    return distance > 0 ? eye + distance * forward : centre;
}

void orbit_camera(Camera& camera, const glm::dvec3& pivot, double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    glm::dmat4 turn(1);
    turn[0] = {std::cos(angle), 0, -std::sin(angle), 0};
    turn[2] = {std::sin(angle), 0, std::cos(angle), 0};
    glm::dmat4 about = turn;
    about[3] = glm::dvec4(pivot - glm::dvec3(turn * glm::dvec4(pivot, 0)), 1);
    camera.camera_to_world = about * camera.camera_to_world;
}

}  // namespace diptych::core
