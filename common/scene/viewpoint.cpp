#include "scene/viewpoint.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "error.h"

namespace diptych::core {
namespace {

void place_eye(const Viewpoint& viewpoint, Camera& camera) {
    if (viewpoint.eye.has_value() != viewpoint.look_at.has_value()) {
        throw Error(viewpoint.eye ? "`eye`: wants `look_at`, the point it looks at"
                                  : "`look_at`: wants `eye`, the point it is seen from");
    }
    if (!viewpoint.eye) {
        if (viewpoint.up) {
            throw Error("`up`: goes with `eye` and `look_at`");
        }
        return;
    }
    const glm::dvec3 back = *viewpoint.eye - *viewpoint.look_at;
    const glm::dvec3 up = viewpoint.up.value_or(glm::dvec3(0, 1, 0));
    if (!(glm::length(back) > 0)) {
        throw Error("`eye`, `look_at`: are one point, so that there is no direction between them");
    }
    if (!(glm::length(up) > 0)) {
        throw Error("`up`: has no direction");
    }
    const glm::dvec3 z = glm::normalize(back);
    const glm::dvec3 right = glm::cross(glm::normalize(up), z);
    if (!(glm::length(right) > 1e-9)) {
        throw Error("`up`: is parallel to the line from `eye` to `look_at`; give another");
    }
    const glm::dvec3 x = glm::normalize(right);
    camera.camera_to_world = glm::dmat4(1);
    camera.camera_to_world[0] = glm::dvec4(x, 0);
    camera.camera_to_world[1] = glm::dvec4(glm::cross(z, x), 0);
    camera.camera_to_world[2] = glm::dvec4(z, 0);
    camera.camera_to_world[3] = glm::dvec4(*viewpoint.eye, 1);
    camera.node = none;
}

}  // namespace

void place_lens(const LensChoice& lens, Camera& camera) {
    camera.lens.radius = lens.radius.value_or(camera.lens.radius);
    camera.lens.focus_distance = lens.focus_distance.value_or(camera.lens.focus_distance);
}

void place_at(const Viewpoint& viewpoint, Camera& camera) {
    place_eye(viewpoint, camera);
    if (viewpoint.fov) {
        if (camera.orthographic) {
            throw Error("`fov`: the camera '" + camera.name + "' is orthographic; give `view_height`");
        }
        camera.vertical_fov = glm::radians(*viewpoint.fov);
    }
    if (viewpoint.view_height) {
        if (!camera.orthographic) {
            throw Error("`view_height`: the camera '" + camera.name + "' is not orthographic; give `fov`");
        }
        camera.orthographic_height = *viewpoint.view_height;
    }
}

Viewpoint viewpoint_of(const Camera& camera, double distance) {
    const glm::dmat4& m = camera.camera_to_world;
    Viewpoint viewpoint;
    viewpoint.eye = glm::dvec3(m[3]);
    viewpoint.look_at = *viewpoint.eye - distance * glm::dvec3(m[2]);
    // +Y where that gives the same picture: the shortest way to say it.
    const bool level = std::abs(m[0].y) < 1e-12 && m[1].y > 1e-6;
    if (!level) {
        viewpoint.up = glm::dvec3(m[1]);
    }
    if (camera.orthographic) {
        viewpoint.view_height = camera.orthographic_height;
    } else {
        viewpoint.fov = glm::degrees(camera.vertical_fov);
    }
    return viewpoint;
}

}  // namespace diptych::core
