// Films of any shape and any number of samples.
#include "case_scenes.h"

namespace diptych::core::stability {

namespace {

Scene sky_alone(float radiance) {
    Scene scene;
    scene.name = "sky";
    add_sky(scene, radiance);
    add_camera(scene, dvec3(0), {0, 0, -1}, 60);
    return scene;
}

/// So many samples in one film, all of 0.1: every pixel must say 0.1.
Measured measure_long_render(Backend& backend, double samples, Effort) {
    Scene scene = sky_alone(0.1F);
    const int side = 64;
    const auto spp = static_cast<std::uint32_t>(std::lround(samples / (side * side)));
    const Film film = render(backend, scene, settings_of(side, side, 1), spp);
    Measured m;
    m.nonfinite = film_totals(film).nonfinite;
    m.evaluations = film_totals(film).samples;
    worsen(m, worst_of(film, double{0.1F}), "");
    return m;
}

/// A lit square seen through films as wide as can be, and of one pixel: each pixel's mean, and what its ray met.
Measured measure_width(Backend& backend, double width, Effort) {
    Scene scene;
    scene.name = "wide";
    Material glow = diffuse(0);
    glow.emission = glm::vec3(0.75F);
    add_material(scene, glow);
    Primitive wall;
    wall.material = 0;
    add_quad(wall, {-1e6F, -1e2F, -1}, {1e6F, -1e2F, -1}, {1e6F, 1e2F, -1}, {-1e6F, 1e2F, -1});
    add_object(scene, "wall", {wall});
    add_camera(scene, dvec3(0), {0, 0, -1}, 1);
    const Film film = render(backend, scene, settings_of(static_cast<int>(std::lround(width)), 1, 1), 4);
    Measured m;
    m.nonfinite = film_totals(film).nonfinite;
    m.evaluations = film_totals(film).samples;
    worsen(m, worst_of(film, 0.75), "");
    worsen(m, film.pixels.size() == static_cast<std::size_t>(std::lround(width)) ? 0.0 : 1.0, "size");
    return m;
}

}  // namespace

void add_film_scene_cases(std::vector<Case>& cases) {
    cases.push_back({"accumulation",
                     "a film of so many samples",
                     {"samples", 4096, 67108864, true, 2, 3, 65536},
                     1e-6,
                     "relative, of any pixel",
                     measure_long_render});
    cases.push_back({"accumulation",
                     "films of one pixel and of 16384 a row",
                     {"width", 1, 16384, true, 2, 3},
                     1e-6,
                     "relative, of any pixel",
                     measure_width});
}

}  // namespace diptych::core::stability
