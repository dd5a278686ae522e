// What must be equal to the bit: thread counts, slices, generic and specialised kernels; and what depths mean.
#include "agreement_scenes.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

RenderSettings small_settings(Integrator integrator, BrdfModel brdf) {
    RenderSettings s;
    s.width = 20;
    s.height = 14;
    s.integrator = integrator;
    s.brdf = brdf;
    s.seed = 11;
    s.max_depth = 6;
    return s;
}

}  // namespace

TEST_CASE("Pictures do not depend on the number of threads") {
    for (const std::string& name : own_scenes()) {
        RenderSettings settings = small_settings(Integrator::path, BrdfModel::ggx);
        settings.width = 50;  // several tiles, the last ones cut
        settings.height = 37;
        const Scene scene = load_own_scene(name);
        INFO(name);
        CHECK(same_film(render_cpu(scene, settings, 4, 1), render_cpu(scene, settings, 4, 2)));
    }
}

TEST_CASE("Pictures do not depend on how their samples are sliced") {
    const Scene scene = load_own_scene("cornell");
    RenderSettings settings = small_settings(Integrator::path, BrdfModel::ggx);
    settings.standard_error = true;
    settings.first_hit_layers = true;
    const PackedScene packed = pack_scene(scene, settings);
    const std::atomic<bool> cancel{false};
    const auto whole = make_cpu_renderer(packed, 2);
    whole->render(0, 40, cancel);
    const auto sliced = make_cpu_renderer(packed, 1);
    std::uint32_t next = 0;
    for (const std::uint32_t count : {1U, 16U, 3U, 17U, 3U}) {
        sliced->render(next, count, cancel);
        next += count;
    }
    const Film a = whole->film();
    const Film b = sliced->film();
    CHECK(next == 40);
    CHECK(same_film(a, b));
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        CHECK(same_bytes(a.moments[i], b.moments[i]));
        CHECK(same_bytes(a.first_hits[i], b.first_hits[i]));
    }
    // And another seed is another picture.
    settings.seed = 12;
    CHECK_FALSE(same_film(render_cpu(scene, settings, 40), a));
}

TEST_CASE("A renderer that starts over has the bits of a new one with that seed") {
    const Scene scene = load_own_scene("cornell");
    RenderSettings settings = small_settings(Integrator::path, BrdfModel::ggx);
    settings.standard_error = true;
    settings.first_hit_layers = true;
    const PackedScene packed = pack_scene(scene, settings);
    const std::atomic<bool> cancel{false};
    const auto renderer = make_cpu_renderer(packed, 2);
    renderer->render(0, 3, cancel);
    renderer->restart(77);
    renderer->render(0, 5, cancel);
    settings.seed = 77;
    const Film fresh = render_cpu(scene, settings, 5);
    const Film again = renderer->film();
    CHECK(same_film(fresh, again));
    for (std::size_t i = 0; i < fresh.pixels.size(); ++i) {
        CHECK(same_bytes(fresh.moments[i], again.moments[i]));
        CHECK(same_bytes(fresh.first_hits[i], again.first_hits[i]));
    }
    renderer->restart(78);
    renderer->render(0, 5, cancel);
    CHECK_FALSE(same_film(fresh, renderer->film()));
}

TEST_CASE("A cancelled render leaves a film that is true to its counts") {
    const Scene scene = load_own_scene("cornell");
    const PackedScene packed = pack_scene(scene, small_settings(Integrator::path, BrdfModel::ggx));
    const auto renderer = make_cpu_renderer(packed, 2);
    const std::atomic<bool> cancel{true};
    renderer->render(0, 64, cancel);
    CHECK(film_totals(renderer->film()).samples == 0);
}

TEST_CASE("The generic kernel gives the specialised one's picture to the bit") {
    std::vector<std::pair<std::string, Scene>> scenes = agreement_scenes();
    for (const std::string& name : own_scenes()) {
        scenes.emplace_back(name, load_own_scene(name));
    }
    for (const auto& [name, scene] : scenes) {
        for (const Integrator integrator : integrators) {
            for (const BrdfModel brdf : brdf_models) {
                RenderSettings settings = small_settings(integrator, brdf);
                const Film specialised = render_cpu(scene, settings, 4);
                settings.generic = true;
                const Film generic = render_cpu(scene, settings, 4);
                INFO(name << " " << name_of(integrator) << " " << name_of(brdf));
                CHECK(same_film(specialised, generic));
                CHECK(film_totals(generic).nonfinite == 0);
            }
        }
    }
}

TEST_CASE("Depth 0 is emission alone, depth 1 adds direct light, depth 2 one bounce") {
    Scene scene;
    scene.name = "depths";
    const int floor = add_material(scene, diffuse_material(0.5F));
    const int light = add_material(scene, make_emitter("light", glm::vec3(2)));
    add_object(scene, "floor", {horizontal_square(glm::vec3(0), 2, true, floor)});
    add_object(scene, "light", {horizontal_square({0, 1, 0}, 0.5F, false, light)});
    for (const Integrator integrator : integrators) {
        scene.cameras = {point_camera({0.05, 0.5, 0.02}, {0.1, 1, 0.1})};
        CHECK(image_mean(render_cpu(scene, statistical_settings(4, 4, integrator, 0), 4)).mean[0] == Approx(2));
        CHECK(image_mean(render_cpu(scene, statistical_settings(4, 4, integrator, 3), 4)).mean[0] == Approx(2));
        scene.cameras = {point_camera({0.6, 0.4, 0.3}, {0, 0, 0})};
        CHECK(image_mean(render_cpu(scene, statistical_settings(4, 4, integrator, 0), 4)).mean[0] == 0);
        const ImageMean direct = image_mean(render_cpu(scene, statistical_settings(16, 16, integrator, 1), 512));
        // The light is black and the floor flat: there is no second bounce.
        const ImageMean more = image_mean(render_cpu(scene, statistical_settings(16, 16, integrator, 4), 512));
        CHECK(direct.mean[0] > 0.2);
        CHECK(worst_z(direct, more) < 4.5);
    }
    // Through a mirror: each reflection is one scattering event.
    Material mirror = make_material("mirror", glm::vec3(1), 1, 0);
    scene.materials[0] = mirror;
    scene.cameras = {point_camera({0.2, 0.3, 0}, {0.1, 0, 0.01})};
    for (const Integrator integrator : integrators) {
        CHECK(image_mean(render_cpu(scene, statistical_settings(4, 4, integrator, 0), 4)).mean[0] == 0);
        CHECK(image_mean(render_cpu(scene, statistical_settings(4, 4, integrator, 1), 64)).mean[0] ==
              Approx(2).epsilon(1e-4));
    }
}

TEST_CASE("No sample of any own scene is dropped") {
    for (const std::string& name : own_scenes()) {
        const Scene scene = load_own_scene(name);
        for (const Integrator integrator : integrators) {
            for (const BrdfModel brdf : brdf_models) {
                RenderSettings settings = small_settings(integrator, brdf);
                settings.max_depth = 16;
                settings.width = 32;
                settings.height = 24;
                const FilmTotals totals = film_totals(render_cpu(scene, settings, 16));
                INFO(name << " " << name_of(integrator) << " " << name_of(brdf));
                CHECK(totals.nonfinite == 0);
                CHECK(totals.samples == 32U * 24U * 16U);
                CHECK(totals.rays >= totals.samples);
            }
        }
    }
}

TEST_CASE("First-hit layers hold albedo, normal and distance") {
    Scene scene = load_own_scene("furnace");
    scene.meshes.clear();
    scene.instances.clear();
    Primitive wall;
    wall.material = add_material(scene, make_material("wall", {0.2F, 0.4F, 0.6F}, 0, 1));
    add_quad(wall, {-9, -9, -3}, {9, -9, -3}, {9, 9, -3}, {-9, 9, -3});
    add_object(scene, "wall", {wall});
    scene.cameras = {point_camera({0, 0, 0}, {0, 0, -1})};
    RenderSettings settings = small_settings(Integrator::path, BrdfModel::ggx);
    settings.first_hit_layers = true;
    const LayeredImage layers = develop(render_cpu(scene, settings, 3));
    REQUIRE(layers.albedo);
    CHECK(layers.albedo->at(3, 4, 2) == Approx(0.6));
    CHECK(layers.normal->at(3, 4, 2) == Approx(1));
    CHECK(layers.depth->at(3, 4, 0) == Approx(3));
    settings.first_hit_layers = false;
    CHECK_FALSE(develop(render_cpu(scene, settings, 3)).albedo);
}
