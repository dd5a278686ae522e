#include "geometry_fixture.h"

#include <atomic>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "backend/cpu_renderer.h"
#include "device/gpu.h"
#include "oracle_renderer/oracle_renderer.h"
#include "renderer/path_renderer.h"
#include "render/film_statistics.h"

namespace diptych::core::tests {
namespace {

double uniform(std::mt19937_64& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

glm::dmat3 random_rotation(std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    const auto vector = [&] { return glm::dvec3{normal(random), normal(random), normal(random)}; };
    const glm::dvec3 x = glm::normalize(vector());
    const glm::dvec3 y = glm::normalize(glm::cross(vector(), x));
    return {x, y, glm::cross(x, y)};
}

double random_factor(std::mt19937_64& random) {
    const double kind = uniform(random, 0, 1);
    const double sign = uniform(random, 0, 1) < 0.5 ? -1 : 1;
    return kind < 0.7   ? sign * uniform(random, 0.3, 2)
           : kind < 0.8 ? 0
           : kind < 0.9 ? sign * std::pow(10, uniform(random, -8, 0))
                        : sign * std::pow(10, uniform(random, -20, 20));
}

Film film_of(Renderer& renderer, std::uint32_t spp) {
    const std::atomic<bool> cancel{false};
    renderer.render(0, spp, cancel);
    return renderer.film();
}

}  // namespace

RenderSettings geometry_settings(int width, int height, std::uint32_t max_depth) {
    RenderSettings s;
    s.width = width;
    s.height = height;
    s.integrator = Integrator::path;
    s.sampler = SamplerKind::independent;
    s.max_depth = max_depth;
    s.seed = 5;
    s.standard_error = true;
    return s;
}

Film render_cpu(const PackedScene& packed, std::uint32_t spp) {
    return film_of(*make_cpu_renderer(packed, 2), spp);
}

Film render_vulkan(const PackedScene& packed, std::uint32_t spp) {
    static const std::shared_ptr<Gpu> gpu = open_gpu({.device = "", .validation = has_validation_layer()});
    PathRenderer renderer(gpu, packed);
    return film_of(renderer, spp);
}

Film render_oracle(const Scene& scene, const RenderSettings& settings, std::uint32_t spp) {
    RenderSettings own = settings;
    own.seed += 100;
    return film_of(*make_oracle_renderer(scene, own, oracle::Mode::mis, 2), spp);
}

Films render_everywhere(const Scene& scene, const RenderSettings& settings, std::uint32_t spp) {
    const PackedScene packed = pack_scene(scene, settings);
    return {render_cpu(packed, spp), render_vulkan(packed, spp), render_oracle(scene, settings, spp)};
}

std::uint64_t count_nonfinite(const Films& films) {
    return film_totals(films.cpu).nonfinite + film_totals(films.vulkan).nonfinite + film_totals(films.oracle).nonfinite;
}

MeanAndError mean_of(const Film& film, int left, int top, int width, int height) {
    MeanAndError out;
    const double n = static_cast<double>(width) * height;
    for (int y = top; y < top + height; ++y) {
        for (int x = left; x < left + width; ++x) {
            const auto i = static_cast<std::size_t>(y * film.width + x);
            out.mean += pixel_mean(film.pixels[i])[0] / n;
            const double error = pixel_standard_error(film.pixels[i], film.moments.at(i))[0] / n;
            out.error += error * error;
        }
    }
    out.error = std::sqrt(out.error);
    return out;
}

MeanAndError mean_of(const Film& film) {
    return mean_of(film, 0, 0, film.width, film.height);
}

glm::dmat3 random_chain(std::mt19937_64& random) {
    const int nodes = 1 + static_cast<int>(random() % 4);
    glm::dmat3 chain(1);
    for (int i = 0; i < nodes; ++i) {
        const glm::dvec3 scale{random_factor(random), random_factor(random), random_factor(random)};
        const glm::dmat3 turn = random() % 4 == 0 ? glm::dmat3(1) : random_rotation(random);
        chain = chain * turn * glm::dmat3(scale.x, 0, 0, 0, scale.y, 0, 0, 0, scale.z);
    }
    return chain;
}

Primitive random_shape(std::mt19937_64& random, int material) {
    Primitive shape;
    shape.material = material;
    switch (random() % 3) {
    case 0:
        add_quad(shape, {-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0});
        return shape;
    case 1:
        add_box(shape, {-1, -1, -1}, {1, 1, 1});
        return shape;
    default:
        return make_sphere(1, 12, 8, material);
    }
}

Material lamp_material() {
    Material m = make_emitter("lamp", glm::vec3(1));
    m.double_sided = true;
    return m;
}

Material white_material() {
    Material m = make_material("white", glm::vec3(1), 0, 1);
    m.specular = 0;
    return m;
}

PunctualLight sun_along(const glm::dvec3& direction) {
    PunctualLight sun;
    sun.name = "sun";
    sun.type = PunctualType::directional;
    sun.intensity = glm::vec3(static_cast<float>(std::numbers::pi));
    const glm::dvec3 up = std::abs(direction.y) < 0.9 * glm::length(direction) ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    sun.light_to_world = glm::inverse(glm::lookAt(glm::dvec3(0), direction, up));
    return sun;
}

}  // namespace diptych::core::tests
