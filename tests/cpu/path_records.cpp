// What is recorded of a path is what was rendered.
#include "render_fixture.h"

#include "agreement_scenes.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

std::vector<shared::PathQuery> all_paths(const RenderSettings& settings, std::uint32_t sample) {
    std::vector<shared::PathQuery> queries;
    for (int y = 0; y < settings.height; ++y) {
        for (int x = 0; x < settings.width; ++x) {
            queries.push_back({{static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)}, sample});
        }
    }
    return queries;
}

}  // namespace

TEST_CASE("recorded paths carry the light of the picture, to the bit") {
    std::vector<std::pair<std::string, Scene>> scenes = agreement_scenes();
    scenes.emplace_back("cornell", load_own_scene("cornell"));
    scenes.emplace_back("normal-map", load_own_scene("normal-map"));
    for (const auto& [name, scene] : scenes) {
        for (const Integrator integrator : integrators) {
            INFO(name << " " << name_of(integrator));
            RenderSettings settings = statistical_settings(16, 12, integrator, 6);
            settings.standard_error = false;
            const PackedScene packed = pack_scene(scene, settings);
            const auto renderer = make_cpu_renderer(packed, 2);
            renderer->render(3, 1, std::atomic<bool>{false});
            const Film film = renderer->film();
            const std::vector<shared::PathQuery> queries = all_paths(settings, 3);
            const std::vector<RecordedPath> paths = renderer->record_paths(queries);
            const std::vector<shared::PathSummary> summaries = renderer->summarize_paths(queries);
            CHECK(same_film(film, renderer->film()));  // left alone
            std::size_t alike = 0;
            double worst_sum = 0;
            for (std::size_t i = 0; i < paths.size(); ++i) {
                std::uint32_t rays = 0;
                glm::dvec3 sum(0);
                for (const shared::PathVertexRecord& v : paths[i].vertices) {
                    rays += v.shadow == shared::SHADOW_NOT_TRACED ? 1 : 2;
                    sum += glm::dvec3(v.emission);
                    sum += v.shadow == shared::SHADOW_FREE ? glm::dvec3(v.direct) : glm::dvec3(0);
                }
                const glm::dvec3 radiance(paths[i].radiance);
                worst_sum = std::max(worst_sum, glm::length(sum - radiance) / (glm::length(radiance) + 1e-3));
                alike += pixel_mean(film.pixels[i]) == Rgb{paths[i].radiance.x, paths[i].radiance.y, paths[i].radiance.z} && rays == film.pixels[i].rays &&
                                 summaries[i].radiance == paths[i].radiance &&
                                 summaries[i].vertices == paths[i].vertices.size()
                             ? 1
                             : 0;
            }
            CHECK(alike == paths.size());
            CHECK(worst_sum < 1e-5);
        }
    }
}

TEST_CASE("Recorded light is weighed where a surface emits or the sky is met, and nowhere else") {
    Scene scene = load_own_scene("cornell");
    scene.environment.kind = EnvironmentKind::constant;
    for (const Integrator integrator : integrators) {
        const RenderSettings settings = statistical_settings(16, 12, integrator, 4);
        const PackedScene packed = pack_scene(scene, settings);
        const auto renderer = make_cpu_renderer(packed, 2);
        int wrong = 0;
        int dark = 0;
        double brightest = 0;
        for (const RecordedPath& path : renderer->record_paths(all_paths(settings, 0))) {
            for (const shared::PathVertexRecord& v : path.vertices) {
                bool emits = v.instance == shared::NONE;
                if (!emits) {
                    const std::uint32_t geometry = packed.instances[v.instance].first_geometry + v.geometry;
                    const shared::Material& material = packed.materials[packed.geometries[geometry].material];
                    emits = material.emission != glm::vec3(0);
                }
                wrong += v.emission_weight < 0 || v.emission_weight > 1 || (!emits && v.emission_weight != 0) ? 1 : 0;
                wrong += v.emission_weight == 0 && v.emission != glm::vec3(0) ? 1 : 0;
                dark += emits ? 0 : 1;
                brightest = std::max(brightest, static_cast<double>(v.emission_weight));
            }
        }
        INFO(name_of(integrator));
        CHECK(wrong == 0);
        CHECK(dark > 100);
        CHECK(brightest == 1);  // seen directly
    }
}
