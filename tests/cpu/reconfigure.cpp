// A renderer that went on with other settings shows what a new one shows.
#include "render_fixture.h"
#include "generate/generate.h"
#include "pose/pose.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

constexpr std::uint32_t samples = 5;

Film shoot(Renderer& renderer) {
    renderer.render(0, samples, std::atomic<bool>(false));
    return renderer.film();
}

RenderSettings plain_settings() {
    RenderSettings s;
    s.width = 24;
    s.height = 18;
    s.max_depth = 3;
    return s;
}

/// Settings to go through, each of which differs from the one before in something that matters.
std::vector<RenderSettings> walk() {
    std::vector<RenderSettings> steps{plain_settings()};
    const auto next = [&](const auto& change) {
        steps.push_back(steps.back());
        change(steps.back());
    };
    next([](RenderSettings& s) { s.integrator = Integrator::brdf; });
    next([](RenderSettings& s) { s.integrator = Integrator::restir, s.moves = true, s.seed = 4; });
    next([](RenderSettings& s) { s.resampling.spatial_passes = 2; });
    next([](RenderSettings& s) { s.width = 33, s.moves = false; });
    next([](RenderSettings& s) { s.integrator = Integrator::ris; });
    next([](RenderSettings& s) { s.integrator = Integrator::path, s.brdf = BrdfModel::blinn_phong; });
    next([](RenderSettings& s) { s.first_hit_layers = true, s.standard_error = true; });
    next([](RenderSettings& s) { s.sampler = SamplerKind::independent, s.height = 7; });
    next([](RenderSettings& s) { s.generic = true; });
    next([](RenderSettings& s) { s = plain_settings(); });
    return steps;
}

void check_walk(const Scene& scene) {
    std::vector<PackedScene> packs;  // all stay: the first one's vertices are referred to
    for (const RenderSettings& settings : walk()) {
        packs.push_back(pack_scene(scene, settings));
    }
    const auto renderer = make_cpu_renderer(packs.front(), 2);
    for (std::size_t i = 0; i < packs.size(); ++i) {
        INFO("step " << i);
        if (i > 0) {
            renderer->reconfigure(packs[i]);
        }
        const Film film = shoot(*renderer);
        const Film fresh = shoot(*make_cpu_renderer(packs[i], 1));
        CHECK(same_film(film, fresh));
        CHECK(film.moments.size() == fresh.moments.size());
        CHECK(film.first_hits.size() == fresh.first_hits.size());
        CHECK(renderer->pass_times().size() == make_cpu_renderer(packs[i], 1)->pass_times().size());
    }
}

}  // namespace

TEST_CASE("A walk through settings shows what new renderers show", "[reconfigure]") {
    check_walk(generate_scene("cornell").scene);
}

TEST_CASE("A walk through settings keeps asking the right materials for alpha", "[reconfigure]") {
    Scene scene = generate_scene("cornell").scene;
    for (Material& material : scene.materials) {
        material.alpha_mode = AlphaMode::blend;
        material.base_color.a = 0.6F;
    }
    check_walk(scene);
}

TEST_CASE("Other settings at another moment, seen from elsewhere", "[reconfigure]") {
    Scene scene = generate_scene("moving-light").scene;
    RenderSettings settings = plain_settings();
    const PackedScene first = pack_scene(scene, settings);
    const auto renderer = make_cpu_renderer(first, 2);
    shoot(*renderer);
    pose_scene(scene, 1.5);
    scene.cameras[0].camera_to_world[3] += glm::dvec4(0.5, 0.25, 0, 0);
    settings.max_depth = 2;
    const PackedScene second = pack_scene(scene, settings);
    renderer->reconfigure(second);
    CHECK(same_film(shoot(*renderer), shoot(*make_cpu_renderer(second, 1))));
}

TEST_CASE("Recording takes another seed and leaves the film's", "[reconfigure]") {
    const Scene scene = generate_scene("cornell").scene;
    RenderSettings settings = plain_settings();
    settings.seed = 3;
    const PackedScene packed = pack_scene(scene, settings);
    const auto renderer = make_cpu_renderer(packed, 1);
    const shared::PathQuery query{{12, 9}, 1};
    settings.seed = 8;
    const PackedScene other = pack_scene(scene, settings);
    const RecordedPath wanted = make_cpu_renderer(other, 1)->record_paths({&query, 1}).front();
    const RecordedPath path = renderer->record_paths({&query, 1}, 8).front();
    REQUIRE(path.vertices.size() == wanted.vertices.size());
    CHECK(!find_parting(path, wanted, 0));
    CHECK(find_parting(path, renderer->record_paths({&query, 1}).front(), 0));
    CHECK(same_film(shoot(*renderer), shoot(*make_cpu_renderer(packed, 1))));
}
