// Russian roulette in rooms whose walls reflect almost nothing in one channel: any channel may be the bright one.
#include <cmath>

#include "render_fixture.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

constexpr double emitted = 0.25;

/// A closed box whose walls all emit and reflect alike.
Scene closed_room(const glm::vec3& albedo) {
    Scene scene;
    scene.name = "room";
    Material glow = diffuse_material(0);
    glow.base_color = glm::vec4(albedo, 1);
    glow.emission = glm::vec3(static_cast<float>(emitted));
    Primitive room;
    room.material = add_material(scene, glow);
    add_box(room, {-1, -1, -1}, {1, 1, 1});
    for (glm::uvec3& t : room.triangles) {
        std::swap(t.y, t.z);
    }
    add_object(scene, "room", {room});
    scene.cameras.push_back(make_camera("camera", {0.1, 0.2, 0.7}, {0, -0.1, -1}, 60));
    return scene;
}

}  // namespace

TEST_CASE("A closed green room holds the furnace's sum in every channel, and so does a red one and a blue one") {
    constexpr std::uint32_t depth = 14;  // far beyond where roulette begins
    for (int turn = 0; turn < 3; ++turn) {
        glm::vec3 albedo(0);
        albedo[(1 + turn) % 3] = 0.9F;
        albedo[(2 + turn) % 3] = 0.1F;
        Rgb truth{};
        for (int c = 0; c < 3; ++c) {
            const double rho = albedo[c];
            truth[static_cast<std::size_t>(c)] = emitted * (1 - std::pow(rho, depth + 1.0)) / (1 - rho);
        }
        for (const Integrator integrator : integrators) {
            const Film film = render_cpu(closed_room(albedo), statistical_settings(16, 16, integrator, depth), 192);
            const ImageMean m = image_mean(film);
            INFO(name_of(integrator) << ", channel " << (1 + turn) % 3 << " bright: " << describe(m) << "truth "
                                     << describe(exactly(truth)));
            CHECK(m.nonfinite == 0);
            CHECK(relative_error(m, exactly(truth)) < 4e-3);
            CHECK(worst_z(m, exactly(truth)) < 4.5);
        }
    }
}
