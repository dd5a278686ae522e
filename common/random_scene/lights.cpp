#include <algorithm>
#include <numbers>

#include "random_scene/parts.h"
#include "generate/shapes.h"

namespace diptych::core {

namespace {

constexpr double degree = std::numbers::pi / 180;

/// Far enough from every surface that 1/r² stays near 1.
PunctualLight random_light(Draws& draws, int number) {
    PunctualLight light;
    light.name = "light" + std::to_string(number);
    light.type = draws.pick({PunctualType::point, PunctualType::spot, PunctualType::directional});
    const glm::dvec3 side = draws.direction();
    const glm::dvec3 eye = draws.between(3, 4) * glm::dvec3(side.x, side.y, std::abs(side.z));
    const glm::dvec3 target = draws.within(-0.4, 0.4);
    light.light_to_world = make_camera("", eye, target, 45).camera_to_world;
    light.moving_color = glm::vec3(draws.within(0.1, 1));
    // Lights are picked by power, and a narrow cone has little: it gets more, or its rare picks would weigh much.
    const double strength = light.type == PunctualType::directional ? draws.between(0.5, 3)
                            : light.type == PunctualType::point     ? draws.between(5, 20)
                                                                    : draws.between(20, 40);
    light.intensity = *light.moving_color * float(strength);
    light.inner_cone = draws.between(0, 20) * degree;
    light.outer_cone = draws.between(25, 45) * degree;
    return light;
}

/// A map with some contrast, so that every texel is met often.
void draw_map(Environment& sky, Draws& draws) {
    sky.kind = EnvironmentKind::map;
    sky.width = 8 + 8 * draws.below(2);
    sky.height = sky.width / 2;
    for (int i = 0; i < sky.width * sky.height; ++i) {
        const double bright = draws.chance(0.1) ? 4 : 1;
        sky.texels.emplace_back(bright * draws.within(0, 1));
    }
}

}  // namespace

void add_random_lights(RandomScene& out, Draws draws) {
    Scene& scene = out.scene;
    const int count = draws.below(4);
    for (int i = 0; i < count; ++i) {
        scene.lights.push_back(random_light(draws, i));
    }
    if (has_room(scene)) {
        return;  // whose walls hide the sky, and shine
    }
    Environment& sky = scene.environment;
    const double kind = draws.between(0, 1);
    const glm::vec3 scale(draws.within(0.1, 0.8));
    if (kind < 0.35) {
        draw_map(sky, draws);
        sky.scale = glm::vec3(scale.x);
        out.sky_degrees = draws.between(-180, 180);
        sky.rotation = out.sky_degrees * degree;
    } else if (kind < 0.85 || scene.lights.empty()) {
        sky.kind = EnvironmentKind::constant;
        sky.scale = scale;
    }
}

}  // namespace diptych::core
