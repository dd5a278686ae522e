// The device's scene at another moment.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "error.h"
#include "gpu_fixture.h"
#include "render/film_statistics.h"
#include "renderer/path_renderer.h"
#include "generate/generate.h"
#include "pose/pose.h"

namespace diptych::core::tests {
namespace {

RenderSettings moment_settings(bool keeps_previous) {
    RenderSettings settings;
    settings.width = 24;
    settings.height = 18;
    settings.max_depth = 3;
    settings.moves = keeps_previous;
    return settings;
}

Film picture_of_seed(Renderer& renderer, std::uint32_t seed) {
    const std::atomic<bool> cancel = false;
    renderer.restart(seed);
    renderer.render(0, 4, cancel);
    return renderer.film();
}

bool same_pixels(const Film& a, const Film& b) {
    return a.pixels.size() == b.pixels.size() &&
           std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(a.pixels[0])) == 0;
}

}  // namespace

TEST_CASE("A renderer that moved has the bits of a new one at that moment, on the device") {
    NEED_VULKAN();
    const Integrator integrator = GENERATE(Integrator::path, Integrator::ris);
    const bool keeps_previous = GENERATE(false, true);
    const LightSampler light_sampler = GENERATE(LightSampler::power, LightSampler::spatial);
    RenderSettings settings = moment_settings(keeps_previous);
    settings.integrator = integrator;
    settings.light_sampler = light_sampler;
    settings.resampling.near_share = 0;  // clusters of lights stay as they were when the scene was packed
    Scene scene = generate_scene("moving-light").scene;
    for (Material& material : scene.materials) {
        material.metallic = 1;  // narrow lobes look for emitters wherever these are
        material.roughness = 0.2F;
    }
    PackedScene packed = pack_scene(scene, settings);
    const std::shared_ptr<Gpu> gpu = open_test_gpu();
    PathRenderer moved(gpu, packed);
    std::vector<Film> films;
    for (const double seconds : {0.5, 1.5, 3.0, 0.5}) {
        CAPTURE(seconds, keeps_previous, static_cast<int>(integrator), static_cast<int>(light_sampler));
        pose_scene(scene, seconds);
        pack_moment(scene, settings, packed);
        moved.move_to(packed);
        films.push_back(picture_of_seed(moved, 7));
        if (seconds > 1) {
            // The light tree keeps its form as well.
            const bool has_tree = light_sampler == LightSampler::spatial;
            const PackedScene posed = has_tree ? packed : pack_scene(scene, settings);
            PathRenderer fresh(gpu, posed);
            CHECK(same_pixels(films.back(), picture_of_seed(fresh, 7)));
        }
    }
    CHECK_FALSE(same_pixels(films[0], films[1]));
    CHECK_FALSE(same_pixels(films[1], films[2]));
    CHECK(same_pixels(films[0], films[3]));
    check_no_validation_messages();
}

TEST_CASE("A renderer keeps film and seed when it moves, and refuses another scene, on the device") {
    NEED_VULKAN();
    const RenderSettings settings = moment_settings(false);
    Scene scene = generate_scene("moving-light").scene;
    PackedScene packed = pack_scene(scene, settings);
    PathRenderer renderer(packed, test_options());
    const Film before = picture_of_seed(renderer, 5);
    pose_scene(scene, 1);
    pack_moment(scene, settings, packed);
    renderer.move_to(packed);
    CHECK(same_pixels(renderer.film(), before));
    PackedScene fewer = packed;
    fewer.instances.pop_back();
    CHECK_THROWS_AS(renderer.move_to(fewer), Error);
    check_no_validation_messages();
}

TEST_CASE("What has no area at a moment is not there, on the device") {
    NEED_VULKAN();
    RenderSettings settings = moment_settings(false);
    settings.integrator = Integrator::brdf;
    Scene scene = generate_scene("moving-light").scene;
    // Flattened along its normal at 0.5 s, which changes nothing; without area at 1 s.
    const auto lamp = std::find_if(scene.nodes.begin(), scene.nodes.end(),
                                   [](const Node& node) { return node.name == "moving lamp"; });
    REQUIRE(lamp != scene.nodes.end());
    const int node = static_cast<int>(lamp - scene.nodes.begin());
    scene.animations = {
        {"",
         {{AnimatedProperty::translation, node, Interpolation::step, {0}, {0, 1.5F, 4}},
          {AnimatedProperty::rotation, node, Interpolation::step, {0}, {-std::sqrt(0.5F), 0, 0, std::sqrt(0.5F)}},
          {AnimatedProperty::scale, node, Interpolation::step, {0, 0.5F, 1}, {5, 5, 5, 5, 0, 5, 0, 0, 5}}}}};
    settings.max_depth = 0;
    PackedScene packed = pack_scene(scene, settings);
    PathRenderer renderer(packed, test_options());
    const auto hits = [&](double seconds) {
        pose_scene(scene, seconds);
        pack_moment(scene, settings, packed);
        renderer.move_to(packed);
        const Film film = picture_of_seed(renderer, 1);
        const shared::FilmPixel& middle = film.pixels[static_cast<std::size_t>(9 * 24 + 12)];
        return rounded(middle.sum)[0] > 1;
    };
    CHECK(hits(0));
    CHECK_FALSE(hits(1));
    CHECK(hits(0.5));
    check_no_validation_messages();
}

}  // namespace diptych::core::tests
