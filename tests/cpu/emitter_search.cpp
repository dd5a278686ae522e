// Sampling the material for light points looks among the emitters alone.
#include <limits>
#include <random>

#include "embree/embree_scene.h"
#include "render_fixture.h"
#include "generate/generate.h"
#include "pose/pose.h"

namespace diptych::core::tests {
namespace {

struct Found {
    std::uint32_t light = ~0U;
    double t = std::numeric_limits<double>::infinity();
};

/// The nearest light that sends light and that rays cannot pass, by looking at all.
Found look_at_all(const PackedScene& packed, const std::vector<bool>& passable, const glm::dvec3& origin,
                  const glm::dvec3& direction) {
    Found found;
    for (std::uint32_t i = 0; i < packed.emissive_triangles.size(); ++i) {
        const shared::EmissiveTriangle& light = packed.emissive_triangles[i];
        const glm::dmat3 corners(-direction, glm::dvec3(light.edge_1), glm::dvec3(light.edge_2));
        const glm::dvec3 at = glm::inverse(corners) * (origin - glm::dvec3(light.vertex_0));
        const bool hit = at.x > 0 && at.y >= 0 && at.z >= 0 && at.y + at.z <= 1;
        if (hit && at.x < found.t && light.pmf > 0 && !passable[light.geometry]) {
            found = {i, at.x};
        }
    }
    return found;
}

}  // namespace

TEST_CASE("The nearest emitter that no ray passes is found, whatever is before it, where it is now") {
    Scene scene = generate_scene("moving-light").scene;
    Material glow = make_emitter("glow", glm::vec3(3));
    glow.alpha_mode = AlphaMode::blend;
    glow.base_color.a = 0.5F;
    add_object(scene, "glow", {horizontal_square({0, 0.8F, 0}, 0.5F, false, add_material(scene, glow))});
    RenderSettings settings = statistical_settings(8, 8, Integrator::ris, 1);
    PackedScene packed = pack_scene(scene, settings);
    EmbreeScene embree(packed);
    std::vector<bool> passable;
    for (const shared::Geometry& geometry : packed.geometries) {
        passable.push_back((packed.materials[geometry.material].flags & shared::MATERIAL_ALPHA_BLEND) != 0);
    }
    std::mt19937 random(3);
    std::uniform_real_distribution<float> anywhere(-1, 1);
    const auto in_box = [&](float half) {
        return half * glm::vec3(anywhere(random), anywhere(random), anywhere(random));
    };
    for (const double seconds : {0.5, 1.5, 3.0}) {
        pose_scene(scene, seconds);
        pack_moment(scene, settings, packed);
        embree.move_to(packed);
        int hits = 0;
        int behind = 0;
        int differ = 0;
        for (int i = 0; i < 20000; ++i) {
            // Past a light, near enough to meet it now and then.
            const shared::EmissiveTriangle& aimed_at =
                packed.emissive_triangles[static_cast<std::size_t>(i) % packed.emissive_triangles.size()];
            const glm::vec3 origin = in_box(3);
            const glm::vec3 direction = glm::normalize(aimed_at.vertex_0 + in_box(0.3F) - origin);
            const EmbreeHit hit = embree.emitter(origin, direction, std::numeric_limits<float>::infinity());
            const Found expected = look_at_all(packed, passable, origin, direction);
            differ += hit.primitive == expected.light ? 0 : 1;
            if (hit.primitive != ~0U) {
                hits += 1;
                behind += embree.any(origin, direction, 0.99F * hit.t, 0) ? 1 : 0;
                CHECK(embree.emitter(origin, direction, 0.9F * hit.t).primitive == ~0U);
                CHECK(std::abs(hit.t - expected.t) < 1e-4 * expected.t + 1e-5);
            }
        }
        INFO(seconds);
        CHECK(differ <= 2);  // rays through an edge
        CHECK(hits > 50);
        CHECK(behind > 10);
    }
}

TEST_CASE("Settings that sample no material for light points build no structure of emitters") {
    const Scene scene = generate_scene("cornell").scene;
    RenderSettings settings = statistical_settings(8, 8, Integrator::path, 1);
    const auto bytes = [&] { return EmbreeScene(pack_scene(scene, settings)).bytes(); };
    const std::uint64_t for_paths = bytes();
    settings.integrator = Integrator::ris;
    const std::uint64_t for_light_points = bytes();
    settings.resampling.bsdf_candidate = false;
    CHECK(for_light_points > for_paths);
    CHECK(for_light_points > bytes());
}

}  // namespace diptych::core::tests
