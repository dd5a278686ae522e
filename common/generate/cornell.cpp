// The Cornell box as measured: Cornell University Program of Computer Graphics, "Cornell Box Data",
// https://www.graphics.cornell.edu/online/box/data.html. Lengths there are millimetres.
//
// Colours are the measured spectra (400 to 700 nm by 4 nm), weighted by the CIE 1931 observer (fits of Wyman, Sloan and
// Shirley 2013), taken to linear Rec.709 and divided by what a spectrum of 1 gives, so that a perfect reflector is (1,
// 1, 1). The light's spectrum (0, 8, 15.6, 18.4 at 400, 500, 600, 700 nm) is treated alike.
// tests/common/generate_cornell.cpp repeats the sum.
#include "generate/scenes.h"
#include "generate/shapes.h"

#include <array>
#include <cmath>

namespace diptych::core {
namespace {

using Quad = std::array<glm::vec3, 4>;

constexpr glm::vec3 cornell_white{0.7378F, 0.7361F, 0.7371F};
constexpr glm::vec3 cornell_red{0.4718F, 0.0468F, 0.0489F};
constexpr glm::vec3 cornell_green{0.0877F, 0.3986F, 0.0843F};
constexpr glm::vec3 cornell_light{17.2F, 11.48F, 3.058F};
constexpr float light_reflectance = 0.78F;

constexpr Quad floor_quad{{{552.8F, 0, 0}, {0, 0, 0}, {0, 0, 559.2F}, {549.6F, 0, 559.2F}}};
constexpr Quad ceiling_quad{{{556, 548.8F, 0}, {556, 548.8F, 559.2F}, {0, 548.8F, 559.2F}, {0, 548.8F, 0}}};
constexpr Quad light_quad{{{343, 548.8F, 227}, {343, 548.8F, 332}, {213, 548.8F, 332}, {213, 548.8F, 227}}};
constexpr Quad back_quad{{{549.6F, 0, 559.2F}, {0, 0, 559.2F}, {0, 548.8F, 559.2F}, {556, 548.8F, 559.2F}}};
constexpr Quad right_quad{{{0, 0, 559.2F}, {0, 0, 0}, {0, 548.8F, 0}, {0, 548.8F, 559.2F}}};
constexpr Quad left_quad{{{552.8F, 0, 0}, {549.6F, 0, 559.2F}, {556, 548.8F, 559.2F}, {556, 548.8F, 0}}};
constexpr Quad short_top{{{130, 165, 65}, {82, 165, 225}, {240, 165, 272}, {290, 165, 114}}};
constexpr Quad tall_top{{{423, 330, 247}, {265, 330, 296}, {314, 330, 456}, {472, 330, 406}}};

void add_metres(Primitive& primitive, const Quad& quad) {
    const auto metres = [](const glm::vec3& p) { return glm::vec3(glm::dvec3(p) / 1000.0); };
    add_quad(primitive, metres(quad[0]), metres(quad[1]), metres(quad[2]), metres(quad[3]));
}

Primitive quad_of(const Quad& quad, int material) {
    Primitive out;
    out.material = material;
    add_metres(out, quad);
    return out;
}

/// The ceiling lies in the light's plane, so it leaves a hole for it: four strips that share their corners.
Primitive ceiling_of(int material) {
    Primitive out;
    out.material = material;
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t j = (i + 1) % 4;
        add_metres(out, {ceiling_quad[i], ceiling_quad[j], light_quad[j], light_quad[i]});
    }
    return out;
}

/// Blocks stand on the floor, so they have no bottom, as measured.
Primitive block_of(const Quad& top, int material) {
    Primitive out = quad_of(top, material);
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t j = (i + 1) % 4;
        const glm::vec3 foot_i(top[i].x, 0, top[i].z), foot_j(top[j].x, 0, top[j].z);
        add_metres(out, {top[j], top[i], foot_i, foot_j});
    }
    return out;
}

}  // namespace

GeneratedScene generate_cornell(const GenerateOptions&) {
    GeneratedScene out;
    Scene& scene = out.scene;
    scene.name = "cornell";
    // Lambertian, as the data say: no specular lobe.
    const auto lambertian = [&](const char* name, const glm::vec3& color) {
        Material material = make_material(name, color, 0, 1);
        material.specular = 0;
        return material;
    };
    const int white_id = add_material(scene, lambertian("white", cornell_white));
    const int red_id = add_material(scene, lambertian("red", cornell_red));
    const int green_id = add_material(scene, lambertian("green", cornell_green));
    Material lamp = lambertian("light", glm::vec3(light_reflectance));
    lamp.emission = cornell_light;
    const int light_id = add_material(scene, lamp);

    add_object(scene, "floor", {quad_of(floor_quad, white_id)});
    add_object(scene, "ceiling", {ceiling_of(white_id)});
    add_object(scene, "back wall", {quad_of(back_quad, white_id)});
    add_object(scene, "right wall", {quad_of(right_quad, green_id)});
    add_object(scene, "left wall", {quad_of(left_quad, red_id)});
    add_object(scene, "light", {quad_of(light_quad, light_id)});
    add_object(scene, "short block", {block_of(short_top, white_id)});
    add_object(scene, "tall block", {block_of(tall_top, white_id)});

    // Focal length 35 mm on a film of 25 mm by 25 mm; rounded, as arc tangents differ between machines in the last
    // digit.
    Camera camera = make_camera("camera", {0.278, 0.273, -0.8}, {0.278, 0.273, 0}, 45);
    camera.vertical_fov = std::round(2 * std::atan(0.0125 / 0.035) * 1e9) / 1e9;
    camera.aspect = 1;
    scene.cameras.push_back(camera);
    return out;
}

}  // namespace diptych::core
