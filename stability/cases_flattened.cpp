// Shapes that a transform flattens: matrices with no inverse, or none in single precision.
#include <glm/gtc/matrix_transform.hpp>

#include "case_scenes.h"
#include "references.h"

namespace diptych::core::stability {

namespace {

/// Below the middle of a square lamp as wide as it is high, which a scale of `thickness` makes of a slanted rectangle.
/// Everything is turned, so that no axis of the matrix is one of the world.
Measured measure_flattened_lamp(Backend& backend, double thickness, bool moves, Effort effort) {
    const double slant = 35 * pi / 180;
    const glm::dmat4 turned = glm::rotate(glm::rotate(glm::dmat4(1), 0.7, {0.0, 0.0, 1.0}), 0.4, {1.0, 0.0, 0.0});
    Scene scene;
    scene.name = "flattened lamp";
    add_material(scene, diffuse(0.5F));
    const int lamp = add_material(scene, make_emitter("lamp", glm::vec3(1)));
    add_object(scene, "floor", {level_square(dvec3(0), 10, true, 0)}, turned);
    const glm::dmat4 flat = glm::scale(glm::dmat4(1), dvec3(1, thickness, 1 / std::cos(slant)));
    const glm::dmat4 slanted = glm::rotate(glm::dmat4(1), slant, dvec3(1, 0, 0));
    add_object(scene, "lamp", {level_square(dvec3(0), 0.5, false, lamp)},
               turned * translation(0, 1, 0) * flat * slanted);
    if (moves) {
        scene.nodes.emplace_back();
        scene.instances.back().node = 0;
    }
    add_camera(scene, {0.9, 0.6, 0.3}, dvec3(0), 1e-3);
    scene.cameras.back().camera_to_world = turned * scene.cameras.back().camera_to_world;
    const Film film = render(backend, scene, settings_of(8, 8, 1), effort == Effort::quick ? 1024 : 65536);
    return judge_mean(film, 0.5 / pi * square_irradiance(0.5, 1));
}

/// A lamp's box, of half axes 1, 0.1 and `depth` times `size`, seen along the last by an orthographic camera `distance` sizes away.
/// No axis of its matrix is one of the world or of its mesh.
Measured measure_lamp_afar(Backend& backend, double size, double distance, double depth, Effort effort) {
    const glm::dmat4 turned = glm::rotate(glm::rotate(glm::dmat4(1), 0.7, {0.0, 0.0, 1.0}), 0.4, {1.0, 0.0, 0.0});
    const glm::dmat4 aslant = glm::rotate(glm::rotate(glm::dmat4(1), 0.9, {0.0, 1.0, 0.0}), 0.5, {0.0, 0.0, 1.0});
    Scene scene;
    scene.name = "lamp afar";
    Primitive box;
    box.material = add_material(scene, make_emitter("lamp", glm::vec3(1)));
    add_box(box, {-1, -1, -1}, {1, 1, 1});
    for (glm::vec3& p : box.positions) {
        p = glm::vec3(glm::transpose(glm::dmat3(aslant)) * glm::dvec3(p));
    }
    box.normals.clear();
    add_object(scene, "lamp", {box}, turned * glm::scale(glm::dmat4(1), size * dvec3(1, 0.1, depth)) * aslant);
    scene.nodes.emplace_back();
    scene.instances.back().node = 0;
    add_camera(scene, {0, 0, distance * size}, dvec3(0), 1);
    Camera& camera = scene.cameras.back();
    camera.camera_to_world = turned * camera.camera_to_world;
    camera.orthographic = true;
    camera.orthographic_height = 0.24 * size;
    const Film film = render(backend, scene, settings_of(80, 8, 1), effort == Effort::quick ? 256 : 4096);
    return judge_mean(film, (2 * 0.2) / (2.4 * 0.24));
}

}  // namespace

void add_flattened_cases(std::vector<Case>& cases) {
    for (const bool moves : {false, true}) {
        cases.push_back({"flattened transforms",
                         moves ? "a lamp that moves, flattened to a thickness" : "a lamp flattened to a thickness",
                         {"thickness", 0, 1e-6, false, 3, 11},
                         0.003,
                         "relative",
                         [moves](Backend& b, double thickness, Effort e) {
                             return measure_flattened_lamp(b, thickness, moves, e);
                         }});
    }
    cases.push_back({"flattened transforms",
                     "a lamp flattened to a thickness that fp32 hardly holds",
                     {"thickness", 1e-38, 1e-7, true, 4, 32},
                     0.003,
                     "relative",
                     [](Backend& b, double thickness, Effort e) {
                         return measure_flattened_lamp(b, thickness, false, e);
                     }});
    cases.push_back({"flattened transforms",
                     "a long lamp that moves, of any size, 1000 of its sizes away",
                     {"size", 1e-6, 1e8, true, 8, 15},
                     0.005,
                     "relative",
                     [](Backend& b, double size, Effort e) { return measure_lamp_afar(b, size, 1000, 0.1, e); }});
    cases.push_back({"flattened transforms",
                     "a long lamp that moves, flattened to nothing, seen from afar",
                     {"sizes away", 1, 1e4, true, 5, 13},
                     0.01,
                     "relative",
                     [](Backend& b, double distance, Effort e) { return measure_lamp_afar(b, 1, distance, 0, e); }});
}

}  // namespace diptych::core::stability
