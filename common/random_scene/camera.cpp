#include "random_scene/parts.h"
#include "generate/shapes.h"

namespace diptych::core {

namespace {

Camera random_camera(Draws& draws, int number) {
    const glm::dvec3 eye{draws.between(-2, 2), draws.between(-1.5, 1.5), draws.between(3.5, 5)};
    const glm::dvec3 target = draws.within(-0.2, 0.2);
    Camera camera = make_camera("camera" + std::to_string(number), eye, target, draws.between(24, 34));
    const double cosine = draws.between(0.7, 1);  // of its roll
    const double sine = draws.sign() * std::sqrt(1 - cosine * cosine);
    const glm::dvec4 right = camera.camera_to_world[0];
    const glm::dvec4 up = camera.camera_to_world[1];
    camera.camera_to_world[0] = cosine * right + sine * up;
    camera.camera_to_world[1] = cosine * up - sine * right;
    camera.orthographic = draws.chance(0.3);
    camera.orthographic_height = draws.between(1.8, 2.6);
    return camera;
}

}  // namespace

void add_random_cameras(RandomScene& out, Draws draws) {
    const int count = 1 + draws.below(3);
    for (int i = 0; i < count; ++i) {
        out.scene.cameras.push_back(random_camera(draws, i));
    }
    out.settings.camera = draws.below(count);
    Camera& camera = out.scene.cameras[std::size_t(out.settings.camera)];
    if (draws.chance(0.3)) {
        camera.lens.radius = draws.between(0.03, 0.2);
        camera.lens.focus_distance = draws.between(3, 5);
    }
    const bool wide = draws.chance(0.5);
    out.settings.width = wide ? 24 : 16;
    out.settings.height = wide ? 16 : 24;
}

}  // namespace diptych::core
