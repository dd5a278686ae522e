// Sampling the material looks for light among the emitters alone. Of those that rays pass by their alpha, or that are
// dark, it finds none; they must hide no other from a driver's traversal.
#include <cstdio>

#include "panels_fixture.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

/// Walls that glow around a lamp of whole triangles and one that half of the light passes.
Scene glowing_room(AlphaMode of_second_lamp) {
    Scene scene = corner_scene(make_emitter("panel", {4, 4, 4}), true);
    Material wall = make_material("glow", {0.5F, 0.5F, 0.5F}, 0, 1);
    wall.emission = glm::vec3(0.3F);
    wall.double_sided = true;
    Primitive walls;
    walls.material = add_material(scene, wall);
    add_box(walls, {-4, -4, -4}, {4, 4, 4});
    add_object(scene, "walls", {walls});
    Material second = make_emitter("second", {2, 1, 3});
    second.alpha_mode = of_second_lamp;
    second.base_color.a = 0.5F;
    add_object(scene, "second", {make_sphere(0.3F, 8, 6, add_material(scene, second))}, translation(0.9, 0.5, 0));
    return scene;
}

}  // namespace

TEST_CASE("An emitter that sampling the material does not find hides no other on the device") {
    NEED_VULKAN();
    for (const AlphaMode mode : {AlphaMode::opaque, AlphaMode::blend, AlphaMode::mask}) {
        const Scene scene = glowing_room(mode);
        const RenderSettings settings = paired_settings(24, 18, Integrator::ris, BrdfModel::ggx);
        const double equal = fraction_equal(render_cpu(scene, settings, 16), render_vulkan(scene, settings, 16));
        std::printf("alpha mode %d: %.2f %% of the pixels equal\n", int(mode), 100 * equal);
        CHECK(equal > 0.97);
    }
}
