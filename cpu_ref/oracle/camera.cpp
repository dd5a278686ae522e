#include "oracle/camera.h"

#include <cmath>

#include "oracle/bsdf.h"

namespace diptych::core::oracle {

Ray camera_ray(const World& world, const Camera& camera, double aspect, double x, double y, Random& random) {
    const double half = camera.orthographic ? 0.5 * camera.orthographic_height : std::tan(0.5 * camera.vertical_fov);
    const dvec3 film((2 * x - 1) * half * aspect, (1 - 2 * y) * half, 0);
    dvec3 start = camera.orthographic ? film : dvec3(0);
    dvec3 direction = camera.orthographic ? dvec3(0, 0, -1) : film + dvec3(0, 0, -1);
    if (camera.lens.radius > 0) {
        const dvec3 focus = start + camera.lens.focus_distance * direction;
        const double radius = camera.lens.radius * std::sqrt(random.uniform());
        const double angle = 2 * pi * random.uniform();
        start += dvec3(radius * std::cos(angle), radius * std::sin(angle), 0);
        direction = focus - start;
    }
    Ray ray;
    ray.origin = dvec3(camera.camera_to_world * dvec4(start, 1)) - world.origin;
    ray.direction = normalize(glm::dmat3(camera.camera_to_world) * direction);
    return ray;
}

}  // namespace diptych::core::oracle
