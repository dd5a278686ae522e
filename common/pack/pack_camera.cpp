#include <cmath>

#include "pack/pack_parts.h"
#include "pack/range.h"

namespace diptych::core {

void pack_camera(const Scene& scene, const RenderSettings& settings, PackedScene& packed) {
    shared::Camera& out = packed.constants.camera;
    out.forward = {0, 0, -1};
    out.focus_distance = 1;
    if (scene.cameras.empty()) {
        return;
    }
    const Camera& camera = scene.cameras[static_cast<std::size_t>(settings.camera)];
    const glm::dmat4& m = camera.camera_to_world;
    const double half_height = camera.orthographic ? camera.orthographic_height / 2 : std::tan(camera.vertical_fov / 2);
    const double aspect = settings.atlas_tile > 0 ? 1.0 : static_cast<double>(settings.width) / settings.height;
    const double half_width = half_height * aspect;
    require_camera(scene, camera, {half_width, half_height}, packed);
    out.kind = camera.orthographic ? shared::CAMERA_ORTHOGRAPHIC : shared::CAMERA_PERSPECTIVE;
    out.origin = glm::vec3(glm::dvec3(m[3]) - packed.origin);
    out.right = glm::vec3(glm::dvec3(m[0]) * half_width);
    out.up = glm::vec3(glm::dvec3(m[1]) * half_height);
    out.forward = glm::vec3(-glm::normalize(glm::dvec3(m[2])));
    out.lens_radius = static_cast<float>(camera.lens.radius);
    out.focus_distance = static_cast<float>(camera.lens.focus_distance);
}

}  // namespace diptych::core
