#include "pack/emitter_corners.h"

#include "pack_fixture.h"

using namespace diptych::core;
using namespace diptych::core::tests;

TEST_CASE("Emitters that sampling the material does not find have no area among the emitters' corners") {
    Scene scene = least_scene();
    for (const AlphaMode mode : {AlphaMode::opaque, AlphaMode::blend, AlphaMode::mask}) {
        Material lamp = make_emitter("lamp", glm::vec3(2));
        lamp.alpha_mode = mode;
        lamp.base_color.a = 0.7F;
        Primitive square;
        square.material = add_material(scene, lamp);
        add_quad(square, {-1, 2, 1}, {1, 2, 1}, {1, 2, -1}, {-1, 2, -1});
        add_object(scene, "lamp", {square}, translation(0, double(mode), 0));
    }
    RenderSettings settings = brdf_settings();
    settings.integrator = Integrator::ris;
    const PackedScene packed = pack_scene(scene, settings);
    const std::vector<shared::vec3> corners = emitter_corners(packed);
    REQUIRE(packed.emissive_triangles.size() == 6);
    REQUIRE(corners.size() == 18);
    for (std::size_t i = 0; i < 6; ++i) {
        const shared::EmissiveTriangle& light = packed.emissive_triangles[i];
        const bool passable = (light.flags & shared::EMITTER_VARIES) != 0;
        const glm::vec3 a = corners[3 * i];
        const float area = glm::length(glm::cross(corners[3 * i + 1] - a, corners[3 * i + 2] - a));
        CHECK(a == light.vertex_0);  // no NaN: a driver's structure loses its neighbours too
        CHECK(area == (passable ? 0.0F : light.double_area));
    }
}
