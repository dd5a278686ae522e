// Stored normals under instances that stretch, shear and mirror: a square whose vertices carry its normal stays flat.
#include <numbers>

#include "render_fixture.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

/// A square across (1, 1, 0), with that normal at its vertices.
Primitive slanted_square(int material) {
    Primitive p;
    p.material = material;
    const glm::vec3 normal = glm::normalize(glm::vec3(1, 1, 0));
    const glm::vec3 across = glm::vec3(-1, 1, 0);
    const glm::vec3 along = glm::vec3(0, 0, 1);
    add_quad(p, across * -2.0F - along * 2.0F, across * -2.0F + along * 2.0F, across * 2.0F + along * 2.0F,
             across * 2.0F - along * 2.0F);
    for (glm::uvec3& t : p.triangles) {
        const glm::vec3 n = glm::cross(p.positions[t.y] - p.positions[t.x], p.positions[t.z] - p.positions[t.x]);
        if (glm::dot(n, normal) < 0) {
            std::swap(t.y, t.z);
        }
    }
    p.normals.assign(p.positions.size(), normal);
    return p;
}

}  // namespace

TEST_CASE("Normals of stretched, sheared and mirrored instances stay across their surface") {
    const std::vector<glm::dmat3> matrices = {
        glm::dmat3(1),
        glm::dmat3(glm::dvec3(3, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)),
        glm::dmat3(glm::dvec3(1, 0, 0), glm::dvec3(0.8, 1, 0), glm::dvec3(0.3, -0.2, 1)),
        glm::dmat3(glm::dvec3(-1, 0, 0), glm::dvec3(0, 2, 0), glm::dvec3(0, 0, 1)),
    };
    for (const glm::dmat3& matrix : matrices) {
        Scene scene;
        scene.name = "slant";
        const int material = add_material(scene, diffuse_material(0.5F));
        add_object(scene, "square", {slanted_square(material)}, glm::dmat4(matrix));
        const glm::dvec3 normal =
            glm::normalize(glm::inverse(glm::transpose(matrix)) * glm::dvec3(1, 1, 0));  // its front, mirrored or not
        const glm::dvec3 sun = glm::normalize(normal + glm::dvec3(0.2, 0.3, 0.5));
        PunctualLight light;
        light.type = PunctualType::directional;
        const glm::dvec3 x = glm::normalize(glm::cross(glm::dvec3(0.3, 0.1, 0.9), sun));
        light.light_to_world =
            glm::dmat4(glm::dvec4(x, 0), glm::dvec4(glm::cross(sun, x), 0), glm::dvec4(sun, 0), glm::dvec4(0, 0, 0, 1));
        scene.lights.push_back(light);
        scene.cameras.push_back(point_camera(normal + glm::dvec3(0.1, 0.2, 0.1), {0, 0, 0}));
        RenderSettings settings = statistical_settings(4, 4, Integrator::path, 1);
        settings.first_hit_layers = true;
        const Film film = render_cpu(scene, settings, 16);
        const ImageMean m = image_mean(film);
        INFO("normal " << normal.x << " " << normal.y << " " << normal.z << ": " << describe(m));
        CHECK(m.nonfinite == 0);
        CHECK(m.mean[0] == Approx(0.5 / std::numbers::pi * glm::dot(normal, sun)).epsilon(1e-4));
        for (int c = 0; c < 3; ++c) {
            CHECK(mean_first_hit(film.pixels[0], film.first_hits[0]).normal[static_cast<std::size_t>(c)] == Approx(normal[c]).epsilon(1e-4).margin(1e-5));
        }
    }
}
