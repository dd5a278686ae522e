// A z-buffer of a few pixels: exact visibility in one pass over the triangles, without a structure to trace rays in.
#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/surface_points.h"

namespace diptych::core {
namespace {

struct PixelHit {
    double depth = std::numeric_limits<double>::infinity();
    const Instance* instance = nullptr;
    const Primitive* primitive = nullptr;
    glm::uvec3 triangle{0};
    glm::dvec3 weights{0};
};

/// Side x side rays in camera space, where the camera looks along -z.
class PixelRays {
public:
    PixelRays(const Camera& camera, int side)
        : orthographic_(camera.orthographic), side_(side),
          half_(camera.orthographic ? camera.orthographic_height / 2 : std::tan(camera.vertical_fov / 2)) {}

    /// Where a ray at place (x, y) in [-1, 1] starts, and its direction, which goes by 1 in depth.
    glm::dvec3 origin(const glm::dvec2& at) const { return orthographic_ ? glm::dvec3(half_ * at, 0) : glm::dvec3(0); }
    glm::dvec3 direction(const glm::dvec2& at) const {
        return orthographic_ ? glm::dvec3(0, 0, -1) : glm::dvec3(half_ * at, -1);
    }
    glm::dvec2 centre(int x, int y) const { return (2.0 * glm::dvec2(x, y) + 1.0) / static_cast<double>(side_) - 1.0; }

    /// The pixels [first, last] whose centres the triangle's shadow on the picture may cover; all where a corner lies
    /// beside or behind the camera. False where there are none.
    bool pixels_around(const glm::dvec3 (&corners)[3], glm::ivec2& first, glm::ivec2& last) const {
        first = glm::ivec2(0);
        last = glm::ivec2(side_ - 1);
        glm::dvec2 lo(1e300);
        glm::dvec2 hi(-1e300);
        int in_front = 0;
        for (const glm::dvec3& corner : corners) {
            in_front += corner.z < 0 ? 1 : 0;
            const glm::dvec2 at = glm::dvec2(corner) / (orthographic_ ? half_ : -half_ * corner.z);
            lo = glm::min(lo, at);
            hi = glm::max(hi, at);
        }
        if (in_front == 0) {
            return false;
        }
        if (in_front < 3) {
            return true;
        }
        if (!(lo.x <= 1 && lo.y <= 1 && hi.x >= -1 && hi.y >= -1)) {
            return false;
        }
        const auto pixel = [&](double at) { return static_cast<int>((std::clamp(at, -1.0, 1.0) + 1) / 2 * side_); };
        first = {pixel(lo.x), pixel(lo.y)};
        last = glm::min(last, glm::ivec2(pixel(hi.x), pixel(hi.y)));
        return true;
    }

private:
    bool orthographic_;
    int side_;
    double half_;
};

/// Moeller and Trumbore 1997; the ray meets the triangle at `depth`, at `weights` of its corners.
bool meets(const glm::dvec3& origin, const glm::dvec3& direction, const glm::dvec3 (&corners)[3], double& depth,
           glm::dvec3& weights) {
    const glm::dvec3 edge_1 = corners[1] - corners[0];
    const glm::dvec3 edge_2 = corners[2] - corners[0];
    const glm::dvec3 p = glm::cross(direction, edge_2);
    const double determinant = glm::dot(edge_1, p);
    const glm::dvec3 from_corner = origin - corners[0];
    const glm::dvec3 q = glm::cross(from_corner, edge_1);
    const double u = glm::dot(from_corner, p) / determinant;
    const double v = glm::dot(direction, q) / determinant;
    depth = glm::dot(edge_2, q) / determinant;
    weights = {1 - u - v, u, v};
    return u >= 0 && v >= 0 && u + v <= 1 && depth > 0;  // false for NaN
}

SurfacePoint point_of(const Scene& scene, const glm::dvec3& peak, const PixelHit& hit, const glm::dvec3& eye,
                      const glm::dvec3& forward) {
    const auto world = [&](unsigned vertex) {
        return glm::dvec3(hit.instance->object_to_world * glm::dvec4(hit.primitive->positions[vertex], 1));
    };
    const glm::dvec3 a = world(hit.triangle.x);
    const glm::dvec3 b = world(hit.triangle.y);
    const glm::dvec3 c = world(hit.triangle.z);
    SurfacePoint point;
    point.position = hit.weights.x * a + hit.weights.y * b + hit.weights.z * c;
    const glm::dvec3 to_camera = forward == glm::dvec3(0) ? eye - point.position : -forward;
    glm::dvec3 front = glm::normalize(glm::cross(b - a, c - a));
    front = glm::determinant(glm::dmat3(hit.instance->object_to_world)) < 0 ? -front : front;
    const bool from_front = glm::dot(front, to_camera) >= 0;
    point.normal = from_front ? front : -front;
    point.material = hit.primitive->material;
    point.two_sided = scene.materials[static_cast<std::size_t>(point.material)].double_sided;
    if (from_front || point.two_sided) {
        point.emission = emission_at(scene, peak, *hit.primitive, hit.triangle, hit.weights);
    }
    return point;
}

}  // namespace

std::vector<SurfacePoint> seen_points(const Scene& scene, const std::vector<glm::dvec3>& peaks, const Camera& camera,
                                      int side) {
    const PixelRays rays(camera, side);
    const glm::dmat4 world_to_camera = glm::inverse(camera.camera_to_world);
    std::vector<PixelHit> pixels(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
    for (const Instance& instance : scene.instances) {
        const glm::dmat4 to_camera = world_to_camera * instance.object_to_world;
        for (const Primitive& primitive : scene.meshes[static_cast<std::size_t>(instance.mesh)].primitives) {
            for (const glm::uvec3& triangle : primitive.triangles) {
                const glm::dvec3 corners[3] = {glm::dvec3(to_camera * glm::dvec4(primitive.positions[triangle.x], 1)),
                                               glm::dvec3(to_camera * glm::dvec4(primitive.positions[triangle.y], 1)),
                                               glm::dvec3(to_camera * glm::dvec4(primitive.positions[triangle.z], 1))};
                glm::ivec2 first;
                glm::ivec2 last;
                if (!rays.pixels_around(corners, first, last)) {
                    continue;
                }
                for (int y = first.y; y <= last.y; ++y) {
                    for (int x = first.x; x <= last.x; ++x) {
                        PixelHit& pixel = pixels[static_cast<std::size_t>(y * side + x)];
                        const glm::dvec2 at = rays.centre(x, y);
                        double depth = 0;
                        glm::dvec3 weights;
                        if (meets(rays.origin(at), rays.direction(at), corners, depth, weights) &&
                            depth < pixel.depth && covered_at(scene, primitive, triangle, weights)) {
                            pixel = {depth, &instance, &primitive, triangle, weights};
                        }
                    }
                }
            }
        }
    }
    const glm::dvec3 eye(camera.camera_to_world[3]);
    const glm::dvec3 forward = camera.orthographic ? -glm::dvec3(camera.camera_to_world[2]) : glm::dvec3(0);
    std::vector<SurfacePoint> points;
    for (const PixelHit& hit : pixels) {
        if (hit.primitive != nullptr) {
            const auto material = static_cast<std::size_t>(hit.primitive->material);
            points.push_back(point_of(scene, peaks[material], hit, eye, forward));
        }
    }
    return points;
}

}  // namespace diptych::core
