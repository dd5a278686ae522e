// Film sums: what is dropped, and how they hold over ten million samples.
#include <random>

#include "film/film_pixel.h"
#include "render_fixture.h"

using namespace diptych::core;
using namespace diptych::core::tests;

TEST_CASE("The film drops and counts what is no radiance") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    shared::FilmPixel pixel{};
    for (const float bad : {nan, -nan, infinity, -infinity, -1.0F, -1e-40F}) {
        for (int c = 0; c < 3; ++c) {
            shared::vec3 radiance(1);
            radiance[c] = bad;
            CHECK_FALSE(shared::film_add(pixel, radiance, 2));
        }
    }
    CHECK(pixel.nonfinite == 18);
    CHECK(pixel.samples == 0);
    CHECK(pixel.rays == 36);
    CHECK(rounded(pixel.sum) == Rgb{0, 0, 0});
    CHECK(shared::film_add(pixel, shared::vec3(-0.0F, 1e-40F, 3e38F), 1));
    CHECK(pixel.samples == 1);
    CHECK(pixel.rays == 37);
    CHECK(rounded(pixel.sum)[2] == static_cast<double>(3e38F));
    CHECK(shared::film_add(pixel, shared::vec3(1, 1, 3e38F), 1));  // the sum is beyond a float
    CHECK(rounded(pixel.sum)[2] == 2 * static_cast<double>(3e38F));
    CHECK(pixel_mean(pixel)[2] == static_cast<double>(3e38F));
}

TEST_CASE("Rays are counted past 2^32 a pixel") {
    shared::FilmPixel pixel{};
    pixel.rays = 0xffffffffU - 9;
    std::uint64_t rays = pixel.rays;
    for (const std::uint32_t more : {4U, 5U, 0U, 1U, 0U, 17U, 0xffffffffU, 0xffffffffU}) {
        shared::film_add(pixel, shared::vec3(1), more);
        rays += more;
        Film film;
        film.pixels = {pixel, pixel};
        CHECK(film_totals(film).rays == 2 * rays);
    }
    CHECK(pixel.ray_wraps == 3);
}

TEST_CASE("Film sums hold over ten million samples") {
    constexpr std::uint32_t n = 10'000'000;
    shared::FilmPixel pixel{};
    shared::FilmMoments moments{};
    std::mt19937 random(5);
    double sum = 0;
    double squares = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
        const float x = static_cast<float>(random() >> 8) * 0x1p-24F;
        const float heavy = x < 1e-4F ? 1e4F * (1 + x) : 0.01F * x;
        const shared::vec3 radiance(0.1F, x, heavy);
        if (shared::film_add(pixel, radiance, 1)) {
            shared::film_add_moments(moments, radiance);
        }
        sum += static_cast<double>(x);
        squares += static_cast<double>(x) * x;
    }
    const Rgb mean = pixel_mean(pixel);
    CHECK(pixel.samples == n);
    CHECK(mean[0] == Approx(static_cast<double>(0.1F)).epsilon(1e-7));
    CHECK(mean[1] == Approx(sum / n).epsilon(1e-7));
    const Rgb error = pixel_standard_error(pixel, moments);
    CHECK(error[0] == 0);
    const double variance = (squares - sum * sum / n) / (n - 1.0);
    CHECK(error[1] == Approx(std::sqrt(variance / n)).epsilon(1e-5));
    // What plain single precision makes of it, so that this test is known to be one.
    float naive = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
        naive += 0.1F;
    }
    CHECK(std::abs(naive / static_cast<float>(n) - 0.1F) > 1e-4F);
}

TEST_CASE("First-hit means hold over ten million samples") {
    Film film;
    film.width = film.height = 1;
    film.pixels.resize(1);
    film.first_hits.resize(1);
    const shared::FirstHit hit{shared::vec3(0.18F, 0.8F, 1.0F), shared::vec3(0, -1, 0), 10.3F};
    for (std::uint32_t n = 1; n <= 10'000'000; ++n) {
        shared::film_add_first_hit(film.first_hits[0], hit);
    }
    film.pixels[0].samples = 10'000'000;
    const LayeredImage layers = develop(film);
    for (int c = 0; c < 3; ++c) {
        CHECK(layers.albedo->data[static_cast<std::size_t>(c)] == hit.albedo[c]);
        CHECK(layers.normal->data[static_cast<std::size_t>(c)] == hit.normal[c]);
    }
    CHECK(layers.depth->data[0] == hit.depth);
}
