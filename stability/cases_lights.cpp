// Lights in pictures: of any power, by the million, at the end of long paths.

#include "case_scenes.h"
#include "references.h"

namespace diptych::core::stability {

namespace {

/// A floor below a square lamp of that radiance, while in a closed room beside it another shines 10^12 times as bright.
Measured measure_dim_lamp(Backend& backend, double radiance, Effort effort) {
    Scene scene;
    scene.name = "dim lamp";
    const int grey = add_material(scene, diffuse(0.5F));
    const int dim = add_material(scene, make_emitter("dim", glm::vec3(static_cast<float>(radiance))));
    const int bright = add_material(scene, make_emitter("bright", glm::vec3(static_cast<float>(radiance * 1e12))));
    add_object(scene, "floor", {level_square(dvec3(0), 2, true, grey)});
    add_object(scene, "dim", {level_square({0, 1, 0}, 0.5, false, dim)});
    const dvec3 beside(8, 0, 0);
    add_object(scene, "bright", {level_square(beside, 0.5, true, bright)});
    add_object(scene, "room", {room(glm::vec3(7, -1, -1), glm::vec3(9, 1, 1), grey)});
    add_camera(scene, {0.9, 0.6, 0.3}, dvec3(0), 1e-3);
    const Film film = render(backend, scene, settings_of(8, 8, 1), effort == Effort::quick ? 2048 : 262144);
    return judge_mean(film, radiance * 0.5 / pi * square_irradiance(0.5, 1));
}

/// A square lamp of a million emitters and more.
Measured measure_many_emitters(Backend& backend, double count, Effort effort) {
    Scene scene;
    scene.name = "many emitters";
    const int grey = add_material(scene, diffuse(0.5F));
    const int lamp = add_material(scene, make_emitter("lamp", glm::vec3(1)));
    add_object(scene, "floor", {level_square(dvec3(0), 10, true, grey)});
    const int side = static_cast<int>(std::lround(std::sqrt(count / 2)));
    Primitive grid;
    grid.material = lamp;
    const auto at = [&](int i) { return static_cast<float>(static_cast<double>(i) / side - 0.5); };
    for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) {
            add_quad(grid, {at(i), 1, at(j)}, {at(i + 1), 1, at(j)}, {at(i + 1), 1, at(j + 1)}, {at(i), 1, at(j + 1)});
        }
    }
    add_object(scene, "lamp", {grid});
    add_camera(scene, {0.9, 0.6, 0.3}, dvec3(0), 1e-3);
    const Film film = render(backend, scene, settings_of(8, 8, 1), effort == Effort::quick ? 1024 : 65536);
    return judge_mean(film, 0.5 / pi * square_irradiance(0.5, 1));
}

/// A room of albedo 0.999 that emits 1: what so many bounces add up to, with roulette from the third on.
Measured measure_white_room(Backend& backend, double depth, Effort effort) {
    Scene scene;
    scene.name = "white room";
    Material glow = diffuse(0.999F);
    glow.emission = glm::vec3(1);
    add_material(scene, glow);
    add_object(scene, "room", {room(glm::vec3(-1), glm::vec3(1), 0)});
    add_camera(scene, {0.1, 0.2, 0.5}, {0, -0.1, -1}, 60);
    const auto bounces = static_cast<std::uint32_t>(std::lround(depth));
    const int side = effort == Effort::quick ? 16 : 64;
    const Film film = render(backend, scene, settings_of(side, side, bounces), effort == Effort::quick ? 64 : 256);
    const double albedo = double{0.999F};
    return judge_mean(film, (1 - std::pow(albedo, bounces + 1.0)) / (1 - albedo));
}

/// Three mirrors of that reflectance each lead to a sky as bright as they are dark: 1, to the last bit but a few.
Measured measure_dark_mirrors(Backend& backend, double reflectance, Effort effort) {
    Scene scene;
    scene.name = "dark mirrors";
    Material mirror = make_material("mirror", glm::vec3(0), 0, 0);
    mirror.ior = 0;  // F0 = F90: the same at every angle
    mirror.specular = static_cast<float>(reflectance);
    add_material(scene, mirror);
    // A slit of two mirrors: at 45 degrees a ray from its middle meets them 3 times and leaves.
    Primitive slit;
    slit.material = 0;
    add_quad(slit, {0, -1, -5}, {6, -1, -5}, {6, -1, 5}, {0, -1, 5});
    add_quad(slit, {0, 1, -5}, {0, 1, 5}, {6, 1, 5}, {6, 1, -5});
    add_object(scene, "slit", {slit});
    const double truth = std::pow(double{mirror.specular}, 3);
    add_sky(scene, static_cast<float>(1 / truth));
    add_camera(scene, {0.2, 0, 0}, {1.2, 1, 0}, 1e-3);
    const Film film = render(backend, scene, settings_of(4, 4, 8), effort == Effort::quick ? 16 : 256);
    return judge_mean(film, truth * double{scene.environment.scale.x});
}

}  // namespace

void add_light_scene_cases(std::vector<Case>& cases) {
    cases.push_back({"light range",
                     "a lamp beside one of 10^12 times its power",
                     {"radiance", 1e-12, 1, true, 2, 7},
                     0.02,
                     "relative",
                     measure_dim_lamp});
    cases.push_back({"light range",
                     "a lamp of many emitters",
                     {"emitters", 2, 1e6, true, 2, 4, 2e4},
                     3e-3,
                     "relative",
                     measure_many_emitters});
    cases.push_back(
        {"roulette", "a room of albedo 0.999", {"bounces", 0, 64, false, 2, 9}, 0.02, "relative", measure_white_room});
    cases.push_back({"roulette",
                     "throughput down to 1e-30 by three mirrors",
                     {"reflectance", 1e-10, 1, true, 2, 11},
                     2e-6,
                     "relative",
                     measure_dark_mirrors});
}

}  // namespace diptych::core::stability
