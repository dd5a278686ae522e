// Four glossy plates that reflect four spheres of equal power and very different size, after Veach and Guibas 1995,
// "Optimally combining sampling techniques for Monte Carlo rendering", figure 2: sampling the light wins at one corner,
// sampling the surface at the other.
#include "generate/scenes.h"
#include "generate/shapes.h"

#include <array>
#include <cmath>

namespace diptych::core {
namespace {

constexpr glm::dvec3 eye{0, 2, 15};
constexpr std::array<float, 4> alphas{0.005F, 0.02F, 0.05F, 0.1F};
constexpr std::array<glm::dvec3, 4> plate_centers{
    {{0, -2.40, -0.15}, {0, -3.06, 0.92}, {0, -3.58, 2.22}, {0, -3.91, 3.58}}};
constexpr std::array<float, 4> radii{0.0333F, 0.1F, 0.3F, 0.9F};
constexpr std::array<glm::vec3, 4> tints{{{1, 0.75F, 0.55F}, {1, 0.95F, 0.6F}, {0.65F, 1, 0.75F}, {0.6F, 0.8F, 1}}};

/// A plate's placement: its +Y halves the angle between the eye and the row of lights.
glm::dmat4 plate_placement(const glm::dvec3& center) {
    const glm::dvec3 up = glm::normalize(glm::normalize(eye - center) + glm::normalize(-center));
    return {glm::dvec4(1, 0, 0, 0), glm::dvec4(up, 0), glm::dvec4(glm::cross(glm::dvec3(1, 0, 0), up), 0),
            glm::dvec4(center, 1)};
}

}  // namespace

GeneratedScene generate_veach_mis(const GenerateOptions&) {
    GeneratedScene out;
    Scene& scene = out.scene;
    scene.name = "veach-mis";

    const int wall = add_material(scene, make_material("wall", glm::vec3(0.4F), 0, 1));
    Primitive room;
    room.material = wall;
    add_quad(room, {-12, -4.2F, 12}, {12, -4.2F, 12}, {12, -4.2F, -2.5F}, {-12, -4.2F, -2.5F});
    add_quad(room, {-12, -4.2F, -2.5F}, {12, -4.2F, -2.5F}, {12, 12, -2.5F}, {-12, 12, -2.5F});
    add_object(scene, "room", {room});

    for (std::size_t i = 0; i < alphas.size(); ++i) {
        const std::string number = std::to_string(i + 1);
        Primitive plate;
        plate.material =
            add_material(scene, make_material("plate " + number, {0.25F, 0.3F, 0.38F}, 1, std::sqrt(alphas[i])));
        add_box(plate, {-4, -0.05F, -0.5F}, {4, 0, 0.5F});
        add_object(scene, "plate " + number, {plate}, plate_placement(plate_centers[i]));
    }
    for (std::size_t i = 0; i < radii.size(); ++i) {
        const std::string number = std::to_string(i + 1);
        const float radiance = 1.5F / (radii[i] * radii[i]);
        const glm::vec3 tint = tints[i] * (3 / (tints[i].x + tints[i].y + tints[i].z));
        const int light = add_material(scene, make_emitter("light " + number, radiance * tint));
        add_object(scene, "light " + number, {make_sphere(radii[i], 32, 16, light)},
                   translation(-3.75 + 2.5 * double(i), 0, 0));
    }
    const int fill = add_material(scene, make_emitter("fill", glm::vec3(600)));
    add_object(scene, "fill", {make_sphere(0.5F, 32, 16, fill)}, translation(10, 10, 6));

    scene.cameras.push_back(make_camera("camera", eye, {0, -2, 2.5}, 28));
    return out;
}

}  // namespace diptych::core
