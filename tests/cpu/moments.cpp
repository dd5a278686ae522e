// A renderer that moved on shows what a new one shows.
#include "embree/embree_scene.h"
#include "error.h"
#include "render_fixture.h"
#include "generate/generate.h"
#include "pose/pose.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

RenderSettings small_settings(Integrator integrator) {
    RenderSettings s;
    s.width = 24;
    s.height = 18;
    s.integrator = integrator;
    s.max_depth = 4;
    return s;
}

Film shoot(Renderer& renderer, std::uint32_t seed) {
    const std::atomic<bool> cancel{false};
    renderer.restart(seed);
    renderer.render(0, 4, cancel);
    return renderer.film();
}

/// A square of half side 1 in the plane y = 0 that stands at x = 10 t.
Scene sliding_square() {
    Scene scene;
    scene.name = "sliding";
    add_material(scene, diffuse_material(0.5F));
    add_object(scene, "square", {horizontal_square({0, 0, 0}, 1, true, 0)});
    scene.nodes.emplace_back();
    scene.instances[0].node = 0;
    scene.animations = {{"",
                         {{AnimatedProperty::translation, 0, Interpolation::linear, {0, 1}, {0, 0, 0, 10, 0, 0}},
                          {AnimatedProperty::scale, 0, Interpolation::step, {0, 1.5F, 2}, {1, 1, 1, 1, 0, 1, 1, 0, 0}}}}};
    return scene;
}

}  // namespace

TEST_CASE("A renderer that moved has the bits of a new one at that moment") {
    const LightSampler light_sampler = GENERATE(LightSampler::power, LightSampler::spatial);
    for (const Integrator integrator : {Integrator::brdf, Integrator::direct, Integrator::path, Integrator::ris}) {
        INFO(name_of(integrator) << ", " << name_of(light_sampler));
        RenderSettings settings = small_settings(integrator);
        settings.light_sampler = light_sampler;
        settings.resampling.near_share = 0;  // clusters of lights stay as they were when the scene was packed
        Scene scene = generate_scene("moving-light").scene;
        for (Material& material : scene.materials) {
            material.metallic = 1;  // narrow lobes look for emitters wherever these are
            material.roughness = 0.2F;
        }
        PackedScene packed = pack_scene(scene, settings);
        const auto moved = make_cpu_renderer(packed, 2);
        std::vector<Film> films;
        for (const double seconds : {0.5, 1.5, 3.0, 0.5}) {
            INFO(seconds);
            pose_scene(scene, seconds);
            pack_moment(scene, settings, packed);
            moved->move_to(packed);
            films.push_back(shoot(*moved, 7));
            // The light tree keeps its form as well.
            const bool has_tree = light_sampler == LightSampler::spatial;
            const PackedScene posed = has_tree ? packed : pack_scene(scene, settings);
            const auto fresh = make_cpu_renderer(posed, 1);
            CHECK(same_film(films.back(), shoot(*fresh, 7)));
        }
        CHECK_FALSE(same_film(films[0], films[1]));
        CHECK_FALSE(same_film(films[1], films[2]));
        CHECK(same_film(films[0], films[3]));
    }
}

TEST_CASE("A renderer may go on with a copy of the scene, and keeps film and seed meanwhile") {
    const RenderSettings settings = small_settings(Integrator::path);
    Scene scene = generate_scene("moving-light").scene;
    const PackedScene first = pack_scene(scene, settings);
    PackedScene second = first;
    pose_scene(scene, 1.5);
    pack_moment(scene, settings, second);
    const auto renderer = make_cpu_renderer(first, 2);
    const Film before = shoot(*renderer, 5);
    renderer->move_to(second);
    CHECK(same_film(renderer->film(), before));
    const Film after = shoot(*renderer, 5);
    CHECK_FALSE(same_film(after, before));
    renderer->move_to(first);
    CHECK(same_film(shoot(*renderer, 5), before));
    PackedScene fewer = first;
    fewer.instances.pop_back();
    CHECK_THROWS_AS(renderer->move_to(fewer), Error);
}

TEST_CASE("Embree follows instances, keeps the moment before where asked, and hits nothing without area") {
    Scene scene = sliding_square();
    RenderSettings settings = small_settings(Integrator::path);
    settings.moves = true;
    PackedScene packed = pack_scene(scene, settings);
    EmbreeScene embree(packed);
    const auto blocked_at = [&](double x, bool before) {
        const glm::vec3 above = glm::vec3(glm::dvec3(x + 0.25, 1, 0.25) - packed.origin);
        return before ? embree.any_previous(above, {0, -1, 0}, 5, 0) : embree.any(above, {0, -1, 0}, 5, 0);
    };
    CHECK(blocked_at(0, false));
    CHECK(blocked_at(0, true));
    double last = 0;
    for (const double seconds : {0.5, 1.0, 0.25}) {
        INFO(seconds);
        pose_scene(scene, seconds);
        pack_moment(scene, settings, packed);
        embree.move_to(packed);
        CHECK(blocked_at(10 * seconds, false));
        CHECK_FALSE(blocked_at(10 * last, false));
        CHECK(blocked_at(10 * last, true));
        CHECK_FALSE(blocked_at(10 * seconds, true));
        last = seconds;
    }
    pose_scene(scene, 2);
    pack_moment(scene, settings, packed);
    embree.move_to(packed);
    CHECK_FALSE(blocked_at(10, false));
    CHECK(blocked_at(2.5, true));
    pose_scene(scene, 1.5);  // flattened along its normal: the same square
    pack_moment(scene, settings, packed);
    embree.move_to(packed);
    CHECK(blocked_at(10, false));
    CHECK_FALSE(blocked_at(10, true));
}

TEST_CASE("A lamp that is off lights nothing, and its room is black") {
    Scene scene = generate_scene("moving-light").scene;
    // Only the lamp that goes off, out at 2 s.
    for (Material& material : scene.materials) {
        if (material.name == "warm") {
            material.emission = glm::vec3(0);
        }
    }
    scene.lights.clear();
    std::erase_if(scene.animations, [](const Animation& a) { return a.name == "spark"; });
    for (Animation& animation : scene.animations) {
        if (animation.name == "switches") {
            animation.channels.erase(animation.channels.begin());
        }
    }
    for (const Integrator integrator : integrators) {
        INFO(name_of(integrator));
        const RenderSettings settings = small_settings(integrator);
        PackedScene packed = pack_scene(scene, settings);
        const auto renderer = make_cpu_renderer(packed, 2);
        for (const double seconds : {1.9, 2.1, 0.0}) {
            pose_scene(scene, seconds);
            pack_moment(scene, settings, packed);
            renderer->move_to(packed);
            const Film film = shoot(*renderer, 3);
            double sum = 0;
            for (const shared::FilmPixel& pixel : film.pixels) {
                sum += pixel_mean(pixel)[0];
            }
            CHECK((sum > 0) == (seconds < 2));
            CHECK(film_totals(film).nonfinite == 0);
        }
        pose_scene(scene, 0);
    }
}
