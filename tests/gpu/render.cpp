// Whole renders on the device.
#include <cmath>
#include <cstring>

#include "gpu_fixture.h"
#include "render/film_statistics.h"
#include "renderer/path_renderer.h"

namespace diptych::core::tests {
namespace {

RenderSettings small_settings() {
    RenderSettings settings;
    settings.width = 45;
    settings.height = 31;
    settings.standard_error = true;
    settings.first_hit_layers = true;
    return settings;
}

Film render_film(const PackedScene& packed, std::uint32_t samples, std::uint64_t slice_budget) {
    PathRenderer renderer(packed, test_options(), {.slice_budget = slice_budget});
    const std::atomic<bool> cancel = false;
    renderer.render(0, samples, cancel);
    return renderer.film();
}

double gray_mean(const shared::FilmPixel& pixel) {
    const Rgb mean = pixel_mean(pixel);
    return (mean[0] + mean[1] + mean[2]) / 3;
}

}  // namespace

TEST_CASE("A render in many slices has the film of one in few, bit for bit") {
    NEED_VULKAN();
    const PackedScene packed = generated_scene("cornell", small_settings());
    const Film whole = render_film(packed, 4, 1U << 24U);
    REQUIRE(whole.pixels.size() == 45 * 31);
    REQUIRE(whole.moments.size() == whole.pixels.size());
    REQUIRE(whole.first_hits.size() == whole.pixels.size());
    for (const std::uint64_t budget : {17U, 100U, 45U * 31U}) {
        CAPTURE(budget);
        const Film sliced = render_film(packed, 4, budget);
        CHECK(same_bytes(whole.pixels, sliced.pixels));
        CHECK(same_bytes(whole.moments, sliced.moments));
        CHECK(same_bytes(whole.first_hits, sliced.first_hits));
    }
    check_no_validation_messages();
}

TEST_CASE("A renderer that starts over has the bits of a new one with that seed, on the device") {
    NEED_VULKAN();
    RenderSettings settings = small_settings();
    PackedScene packed = generated_scene("cornell", settings);
    PathRenderer renderer(packed, test_options(), {.slice_budget = 100});
    const std::atomic<bool> cancel = false;
    renderer.render(0, 2, cancel);
    renderer.restart(77);
    renderer.render(0, 3, cancel);
    packed.constants.seed = 77;
    const Film fresh = render_film(packed, 3, 100);
    CHECK(same_bytes(fresh.pixels, renderer.film().pixels));
    CHECK(same_bytes(fresh.moments, renderer.film().moments));
    CHECK(same_bytes(fresh.first_hits, renderer.film().first_hits));
    renderer.restart(0);
    renderer.render(0, 3, cancel);
    CHECK_FALSE(same_bytes(fresh.pixels, renderer.film().pixels));
    check_no_validation_messages();
}

TEST_CASE("A specialised pipeline gives the image of the generic one") {
    NEED_VULKAN();
    const std::string name = GENERATE("cornell", "veach-mis", "normal-map");
    CAPTURE(name);
    RenderSettings settings = small_settings();
    const Film specialised = render_film(generated_scene(name, settings), 4, 0);
    settings.generic = true;
    const Film generic = render_film(generated_scene(name, settings), 4, 0);
    REQUIRE(generic.pixels.size() == specialised.pixels.size());
    int different = 0;
    double sum_specialised = 0;
    double sum_generic = 0;
    for (std::size_t i = 0; i < generic.pixels.size(); ++i) {
        const double a = gray_mean(specialised.pixels[i]);
        const double b = gray_mean(generic.pixels[i]);
        different += std::abs(a - b) > 1e-3 * std::max(a, b) + 1e-6 ? 1 : 0;
        sum_specialised += a;
        sum_generic += b;
    }
    // The compiler may round differently where code is left out, so that a rare path parts; not more.
    CHECK(different <= 7);
    CHECK(sum_specialised == Approx(sum_generic).epsilon(2e-3));
    CHECK(sum_generic > 1.0);
    check_no_validation_messages();
}

TEST_CASE("Layers that are not asked for are not there") {
    NEED_VULKAN();
    RenderSettings settings = small_settings();
    settings.standard_error = false;
    settings.first_hit_layers = false;
    const Film film = render_film(generated_scene("cornell", settings), 1, 0);
    CHECK(film.pixels.size() == 45 * 31);
    CHECK(film.moments.empty());
    CHECK(film.first_hits.empty());
}

TEST_CASE("A render adds to what is there, and stops where it is told to") {
    NEED_VULKAN();
    const PackedScene packed = generated_scene("cornell", small_settings());
    PathRenderer renderer(packed, test_options());
    std::atomic<bool> cancel = false;
    renderer.render(0, 2, cancel);
    renderer.render(2, 3, cancel);
    cancel = true;
    renderer.render(5, 1000, cancel);
    const Film film = renderer.film();
    for (const shared::FilmPixel& pixel : film.pixels) {
        CHECK(pixel.samples + pixel.nonfinite == 5);
    }
    CHECK(renderer.device_seconds() > 0);
    CHECK(same_bytes(film.pixels, render_film(packed, 5, 0).pixels));
    check_no_validation_messages();
}

TEST_CASE("Compacted acceleration structures are no larger than built ones, and are counted") {
    NEED_VULKAN();
    const PathRenderer renderer(generated_scene("courtyard", small_settings()), test_options());
    CHECK(renderer.bottom_levels().bytes > 0);
    // A driver that wastes nothing at first has nothing to give back.
    CHECK(renderer.bottom_levels().bytes <= renderer.bottom_levels().built_bytes);
    CHECK(renderer.costs().bytes > renderer.bottom_levels().bytes);
    check_no_validation_messages();
}

TEST_CASE("The traversal bench traces the integrator's rays, and leaves the film alone") {
    NEED_VULKAN();
    const PackedScene packed = generated_scene("cornell", small_settings());
    PathRenderer renderer(packed, test_options());
    const TraversalBench bench = renderer.bench_traversal(3);
    std::uint64_t rays = 0;
    for (const shared::FilmPixel& pixel : render_film(packed, 3, 0).pixels) {
        rays += pixel.rays;
    }
    CHECK(bench.rays == rays);
    CHECK(bench.integrator_seconds > 0);
    CHECK(bench.bare_seconds > 0);
    for (const shared::FilmPixel& pixel : renderer.film().pixels) {
        CHECK(pixel.rays == 0);
    }
    check_no_validation_messages();
}

}  // namespace diptych::core::tests
