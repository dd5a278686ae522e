// The density with which light sampling would have found a point of an emitter, which weighs every hit on one: in closed form, and as
// light sampling states it.
#include <numbers>

#include "test_kernel.h"
#include "render_fixture.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

struct Fixture {
    PackedScene packed;
    EmbreeScene embree;
    Kernel kernel;

    Fixture()
        : packed(pack_scene(lamp(), statistical_settings(4, 4, Integrator::path, 1))),
          embree(packed), kernel{packed, packed.constants, {{embree}}} {}

    static Scene lamp() {
        Scene scene;
        add_object(scene, "lamp", {horizontal_square({0, 1, 0}, 1, false, add_material(scene, make_emitter("lamp", glm::vec3(1))))});
        scene.cameras.push_back(point_camera({0, 0, 1}, {0, 1, 0}));
        return scene;
    }
};

shared::EmissiveTriangle emitter(const glm::vec3& vertex_0, const glm::vec3& edge_1, const glm::vec3& edge_2) {
    shared::EmissiveTriangle light{};
    light.vertex_0 = vertex_0;
    light.edge_1 = edge_1;
    light.edge_2 = edge_2;
    const glm::vec3 across = glm::cross(edge_1, edge_2);
    light.double_area = glm::length(across);
    light.front = across / light.double_area;
    light.radiance = glm::vec3(1);
    return light;
}

constexpr glm::dvec2 places[] = {{0.2, 0.3}, {0.7, 0.1}, {0.05, 0.9}, {0, 0}};

glm::vec3 point_at(const shared::EmissiveTriangle& light, const glm::dvec2& b) {
    return light.vertex_0 + static_cast<float>(b.x) * light.edge_1 + static_cast<float>(b.y) * light.edge_2;
}

}  // namespace

TEST_CASE("An emitter close by has the density of its solid angle, one far off that of its area") {
    Fixture f;
    const glm::vec3 reference(3, -2, 5);
    // Its corners lie on the axes about the reference point: an octant.
    const shared::EmissiveTriangle octant = emitter(reference + glm::vec3(2, 0, 0), {-2, 2, 0}, {-2, 0, 2});
    const shared::EmissiveTriangle far = emitter({6, 9, -8}, {0.02F, 0.01F, 0}, {0, -0.01F, 0.03F});
    for (const glm::dvec2& b : places) {
        CAPTURE(b.x, b.y);
        CHECK(f.kernel.pdf_emitter(octant, 0.25F, reference, point_at(octant, b)) == Approx(0.25 / (0.5 * std::numbers::pi)).epsilon(1e-5));
        const glm::dvec3 to = glm::dvec3(point_at(far, b)) - glm::dvec3(reference);
        const double cosine = std::abs(glm::dot(glm::normalize(to), glm::dvec3(far.front)));
        const double expected = 0.25 * glm::dot(to, to) / (0.5 * static_cast<double>(far.double_area) * cosine);
        CHECK(f.kernel.pdf_emitter(far, 0.25F, reference, point_at(far, b)) == Approx(expected).epsilon(1e-5));
    }
}

TEST_CASE("A hit on an emitter is weighed by the density that light sampling states for the same point") {
    Fixture f;
    const shared::EmissiveTriangle light = emitter({0.5F, 2, -1}, {1, 0.3F, 0}, {0.2F, -0.1F, 0.8F});
    int flat = 0;
    for (const float distance : {0.1F, 1.0F, 10.0F, 100.0F, 1000.0F}) {
        const glm::vec3 reference = point_at(light, {0.3, 0.3}) + distance * (light.front + glm::vec3(0.3F, 0.1F, -0.2F));
        for (const glm::dvec2& u : places) {
            const auto on_emitter = f.kernel.sample_emitter_point(light, reference, glm::vec2(u));
            const auto sampled = f.kernel.sample_emitter(light, 0.25F, reference, on_emitter);
            CAPTURE(distance, u.x, u.y);
            CHECK(sampled.pdf > 0);
            CHECK(f.kernel.pdf_emitter(light, 0.25F, reference, point_at(light, on_emitter.barycentrics)) == Approx(sampled.pdf).epsilon(1e-4));
        }
        flat += distance >= 100 ? 1 : 0;
    }
    CHECK(flat == 2);  // seen as flat, beyond 3e-4 sr
}
