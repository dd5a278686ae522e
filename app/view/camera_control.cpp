#include "view/camera_control.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "settings/ranges.h"
#include "pose/pose.h"

namespace diptych::core::app {

namespace {

constexpr double highest = 89.9 * glm::pi<double>() / 180;  // elevation of the camera's axis
constexpr double least_fov = ranges::fov.accepted.least * glm::pi<double>() / 180;
constexpr double most_fov = ranges::fov.accepted.most * glm::pi<double>() / 180;

glm::dvec3 axis(const Camera& camera, int column) {
    return glm::dvec3(camera.camera_to_world[column]);
}

glm::dvec3 eye_of(const Camera& camera) {
    return axis(camera, 3);
}

/// Rodrigues: the rotation about a unit axis, counter-clockwise as seen from its tip.
glm::dmat3 rotation(const glm::dvec3& about, double angle) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const glm::dmat3 cross(0, about.z, -about.y, -about.z, 0, about.x, about.y, -about.x, 0);
    return glm::dmat3(c) + s * cross + (1 - c) * glm::outerProduct(about, about);
}

void turn(Camera& camera, const glm::dmat3& by, const glm::dvec3& pivot) {
    glm::dmat4& m = camera.camera_to_world;
    const glm::dvec3 eye = pivot + by * (glm::dvec3(m[3]) - pivot);
    m = glm::dmat4(by * glm::dmat3(m));
    m[3] = glm::dvec4(eye, 1);
    // Thousands of turns would shear it.
    m = rigid_part(m).value_or(m);
}

/// `elevation` changed by `pitch`, stopped at the poles; one that is beyond them may come back.
double stopped(double elevation, double pitch) {
    const double low = std::min(-highest, elevation);
    const double high = std::max(highest, elevation);
    return std::clamp(elevation + pitch, low, high);
}

/// Half the film's extent, metres at distance 1 of a perspective camera, anywhere of an orthographic one.
glm::dvec2 half_extent(const Camera& camera, double aspect) {
    const double height = camera.orthographic ? camera.orthographic_height / 2 : std::tan(camera.vertical_fov / 2);
    return {height * aspect, height};
}

/// Film point to [-1, 1]^2, y up.
glm::dvec2 centred(const glm::dvec2& film) {
    return {2 * film.x - 1, 1 - 2 * film.y};
}

}  // namespace

void orbit(Camera& camera, const glm::dvec3& pivot, double yaw, double pitch) {
    turn(camera, rotation({0, 1, 0}, yaw), pivot);
    const glm::dvec3 back = axis(camera, 2);
    const glm::dvec3 level = glm::cross(glm::dvec3(0, 1, 0), back);
    const double length = glm::length(level);
    const glm::dvec3 about = length > 1e-9 ? level / length : axis(camera, 0);
    const double elevation = std::atan2(back.y, length);
    turn(camera, rotation(about, elevation - stopped(elevation, pitch)), pivot);
}

void look(Camera& camera, double yaw, double pitch) {
    orbit(camera, eye_of(camera), yaw, -pitch);
}

void fly(Camera& camera, const glm::dvec3& steps) {
    const glm::dvec3 moved = axis(camera, 0) * steps.x + axis(camera, 1) * steps.y - axis(camera, 2) * steps.z;
    camera.camera_to_world[3] += glm::dvec4(moved, 0);
}

double fly_speed(double scene_diagonal) {
    constexpr double seconds_across = 5;
    return std::max(scene_diagonal, 1e-6) / seconds_across;
}

void pan(Camera& camera, const glm::dvec2& from, const glm::dvec2& to, double aspect, double depth) {
    const glm::dvec2 shift =
        (centred(from) - centred(to)) * half_extent(camera, aspect) * (camera.orthographic ? 1.0 : depth);
    fly(camera, {shift.x, shift.y, 0});
}

void dolly(Camera& camera, const glm::dvec3& pivot, double factor, double scene_diagonal) {
    const glm::dvec3 away = eye_of(camera) - pivot;
    const double distance = glm::length(away);
    const double least = 1e-6 * std::max(scene_diagonal, 1e-6);
    if (distance > 0) {
        const double wanted = std::max(distance * factor, std::min(least, distance));
        camera.camera_to_world[3] = glm::dvec4(pivot + away * (wanted / distance), 1);
    }
    if (camera.orthographic) {
        camera.orthographic_height = std::max(camera.orthographic_height * factor, least);
    }
}

glm::dvec3 point_seen(const Camera& camera, const glm::dvec2& film, double aspect, double distance) {
    const glm::dvec2 across = centred(film) * half_extent(camera, aspect);
    const glm::dvec3 sideways = axis(camera, 0) * across.x + axis(camera, 1) * across.y;
    if (camera.orthographic) {
        return eye_of(camera) + sideways - axis(camera, 2) * distance;
    }
    return eye_of(camera) + glm::normalize(sideways - axis(camera, 2)) * distance;
}

bool focus_on(Camera& camera, const glm::dvec3& point) {
    const double depth = glm::dot(eye_of(camera) - point, axis(camera, 2));
    if (!(depth > 0)) {
        return false;
    }
    camera.lens.focus_distance = depth;
    return true;
}

void set_field_of_view(Camera& camera, double radians, double distance) {
    const double fov = std::clamp(radians, least_fov, most_fov);
    if (camera.orthographic) {
        camera.orthographic_height = 2 * distance * std::tan(fov / 2);
    } else {
        camera.vertical_fov = fov;
    }
}

double depth_of(const Camera& camera, const glm::dvec3& point, double least) {
    return std::max(glm::dot(eye_of(camera) - point, axis(camera, 2)), least);
}

}  // namespace diptych::core::app
