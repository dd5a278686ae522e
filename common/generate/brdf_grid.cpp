// Spheres in a studio: roughness grows to the right, metalness upwards. The setting `brdf` chooses the
// microfacet model of all of them.
#include "generate/scenes.h"
#include "generate/shapes.h"

#include <array>
#include <cstdio>

namespace diptych::core {
namespace {

constexpr std::array<float, 7> roughnesses{0.05F, 0.15F, 0.3F, 0.45F, 0.6F, 0.8F, 1.0F};
constexpr std::array<float, 5> metalnesses{0, 0.25F, 0.5F, 0.75F, 1};

/// A lamp whose front is the local +Z side: a dark housing and a panel 5 mm before it.
void add_lamp(Scene& scene, const std::string& name, int housing, float half_width, float half_height,
              const glm::vec3& radiance, const glm::dvec3& at, const glm::dvec3& target) {
    Primitive body;
    body.material = housing;
    add_box(body, {-half_width - 0.05F, -half_height - 0.05F, -0.1F}, {half_width + 0.05F, half_height + 0.05F, 0});
    Primitive panel;
    panel.material = add_material(scene, make_emitter(name, radiance));
    constexpr float z = 0.005F;
    add_quad(panel, {-half_width, -half_height, z}, {half_width, -half_height, z}, {half_width, half_height, z},
             {-half_width, half_height, z});
    // A camera looks along -Z, so one that looks away from the target has its +Z towards it.
    add_object(scene, name, {body, panel}, make_camera("", at, 2.0 * at - target, 45).camera_to_world);
}

}  // namespace

GeneratedScene generate_brdf_grid(const GenerateOptions&) {
    GeneratedScene out;
    Scene& scene = out.scene;
    scene.name = "brdf-grid";

    Primitive floor, walls;
    floor.material = add_material(scene, make_material("floor", {0.3F, 0.3F, 0.32F}, 0, 0.5F));
    walls.material = add_material(scene, make_material("walls", {0.45F, 0.45F, 0.47F}, 0, 1));
    constexpr float w = 7, h = 8, near = 12, far = -1.5F;
    add_quad(floor, {-w, 0, near}, {w, 0, near}, {w, 0, far}, {-w, 0, far});
    add_quad(walls, {-w, 0, far}, {w, 0, far}, {w, h, far}, {-w, h, far});
    add_quad(walls, {w, 0, near}, {-w, 0, near}, {-w, h, near}, {w, h, near});
    add_quad(walls, {-w, 0, near}, {-w, 0, far}, {-w, h, far}, {-w, h, near});
    add_quad(walls, {w, 0, far}, {w, 0, near}, {w, h, near}, {w, h, far});
    add_quad(walls, {-w, h, far}, {w, h, far}, {w, h, near}, {-w, h, near});
    add_object(scene, "studio", {floor, walls});

    for (std::size_t row = 0; row < metalnesses.size(); ++row) {
        for (std::size_t column = 0; column < roughnesses.size(); ++column) {
            std::array<char, 64> name{};
            std::snprintf(name.data(), name.size(), "roughness %.2f metalness %.2f", double(roughnesses[column]),
                          double(metalnesses[row]));
            const int material = add_material(
                scene, make_material(name.data(), {0.9F, 0.5F, 0.2F}, metalnesses[row], roughnesses[column]));
            add_object(scene, name.data(), {make_sphere(0.45F, 64, 32, material)},
                       translation(-3.3 + 1.1 * double(column), 0.55 + 1.1 * double(row), 0));
        }
    }
    const int housing = add_material(scene, make_material("housing", glm::vec3(0.05F), 0, 0.6F));
    add_lamp(scene, "large lamp", housing, 1.2F, 1.2F, {12, 12, 12.8F}, {-5, 6, 6}, {0, 2.5, 0});
    add_lamp(scene, "small lamp", housing, 0.3F, 0.3F, {110, 98, 80}, {5, 5.5, 5}, {0, 2.5, 0});

    scene.cameras.push_back(make_camera("camera", {0, 2.75, 10.5}, {0, 2.75, 0}, 32));
    return out;
}

}  // namespace diptych::core
