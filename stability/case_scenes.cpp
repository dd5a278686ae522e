#include "case_scenes.h"

#include <algorithm>

#include "render/film_statistics.h"

namespace diptych::core::stability {

RenderSettings settings_of(int width, int height, std::uint32_t max_depth) {
    RenderSettings s;
    s.width = width;
    s.height = height;
    s.max_depth = max_depth;
    s.seed = 1;
    return s;
}

Film render(Backend& backend, const Scene& scene, const RenderSettings& settings, std::uint32_t spp) {
    const PackedScene packed = pack_scene(scene, settings);
    const std::unique_ptr<Renderer> renderer = backend.make_renderer(packed);
    const std::atomic<bool> cancel{false};
    renderer->render(0, spp, cancel);
    return renderer->film();
}

Material diffuse(float albedo) {
    Material m = make_material("diffuse", glm::vec3(albedo), 0, 1);
    m.specular = 0;
    return m;
}

Primitive level_square(const dvec3& center, double half, bool front_up, int material) {
    Primitive p;
    p.material = material;
    const dvec3 x(half, 0, 0);
    const dvec3 z(0, 0, front_up ? -half : half);
    add_quad(p, center - x - z, center + x - z, center + x + z, center - x + z);
    return p;
}

Primitive room(const glm::vec3& low, const glm::vec3& high, int material) {
    Primitive p;
    p.material = material;
    add_box(p, low, high);
    for (glm::uvec3& t : p.triangles) {
        std::swap(t.y, t.z);
    }
    return p;
}

void add_camera(Scene& scene, const dvec3& eye, const dvec3& target, double degrees) {
    scene.cameras.push_back(make_camera("camera", eye, target, degrees));
}

void add_sky(Scene& scene, float radiance) {
    scene.environment.kind = Environment::Kind::constant;
    scene.environment.scale = glm::vec3(radiance);
}

double mean_of(const Film& film) {
    double sum = 0;
    for (const shared::FilmPixel& pixel : film.pixels) {
        sum += pixel_mean(pixel)[0];
    }
    return sum / static_cast<double>(film.pixels.size());
}

double worst_of(const Film& film, double truth) {
    double worst = 0;
    for (const shared::FilmPixel& pixel : film.pixels) {
        worst = std::max(worst, relative_error(pixel_mean(pixel)[0], truth));
    }
    return worst;
}

Measured judge_mean(const Film& film, double truth) {
    const FilmTotals totals = film_totals(film);
    Measured m;
    m.nonfinite = totals.nonfinite;
    m.evaluations = totals.samples;
    const double mean = mean_of(film);
    worsen(m, relative_error(mean, truth), fmt::format("{:.6g} for {:.6g}", mean, truth));
    return m;
}

}  // namespace diptych::core::stability
