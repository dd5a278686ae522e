// A closed room in which every surface emits 0.25 and reflects half, so that every ray sees Le / (1 - rho) = 0.5; with
// n bounces it sees 0.25 (1 - 0.5^(n + 1)) / 0.5. Faces are flat: shading normals would break the closed form.
#include "generate/scenes.h"
#include "generate/shapes.h"

#include <utility>

namespace diptych::core {

GeneratedScene generate_furnace(const GenerateOptions&) {
    GeneratedScene out;
    Scene& scene = out.scene;
    scene.name = "furnace";
    Material glow = make_material("glow", glm::vec3(0.5F), 0, 1);
    glow.specular = 0;
    glow.emission = glm::vec3(0.25F);
    const int material = add_material(scene, glow);

    Primitive room;
    room.material = material;
    add_box(room, {-1, -1, -1}, {1, 1, 1});
    for (glm::uvec3& triangle : room.triangles) {
        std::swap(triangle.y, triangle.z);
    }
    add_object(scene, "room", {room});

    Primitive ball = make_sphere(0.35F, 24, 12, material);
    ball.normals.clear();
    add_object(scene, "ball", {ball}, translation(-0.4, -0.3, -0.3));
    Primitive block;
    block.material = material;
    add_box(block, {-0.25F, -0.25F, -0.25F}, {0.25F, 0.25F, 0.25F});
    // Turned by angles whose sines and cosines are quotients, so that no machine rounds them another way.
    const glm::dmat3 about_y(0.8, 0, -0.6, 0, 1, 0, 0.6, 0, 0.8);
    const glm::dmat3 about_x(1, 0, 0, 0, 12.0 / 13, 5.0 / 13, 0, -5.0 / 13, 12.0 / 13);
    add_object(scene, "block", {block}, translation(0.45, -0.2, -0.2) * glm::dmat4(about_y * about_x));

    scene.cameras.push_back(make_camera("camera", {0, 0.2, 0.9}, {0, -0.1, -1}, 60));
    return out;
}

}  // namespace diptych::core
