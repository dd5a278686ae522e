// Films as values: layers, merging, files.
#include <cmath>

#include "library/library_fixture.h"

using namespace library_tests;

namespace {

dp::Film of_seed(std::uint32_t seed, std::uint32_t spp, const dp::Scene& scene) {
    dp::Settings settings = small_settings();
    settings.seed = seed;
    return rendered(scene, dp::Backend::cpu, settings, spp);
}

}  // namespace

TEST_CASE("Arrays have the film's size, and layers that were not kept are empty") {
    const dp::Scene scene = small_scene();
    const dp::Film film = of_seed(0, 2, scene);
    const std::size_t pixels = 24 * 16;
    CHECK(film.radiance().size() == 3 * pixels);
    CHECK(film.standard_error().size() == 3 * pixels);
    CHECK(film.layer("albedo").size() == 3 * pixels);
    CHECK(film.layer("normal").size() == 3 * pixels);
    CHECK(film.layer("depth").size() == pixels);
    CHECK(film.layer("radiance").data() == film.radiance().data());
    CHECK_THROWS_WITH(film.layer("albdo"), Catch::Contains("no layer 'albdo'"));
    const dp::Film copy = film;
    CHECK(copy.radiance().data() == film.radiance().data());

    dp::Settings bare = small_settings();
    bare.standard_error = false;
    bare.first_hit = false;
    const dp::Film plain = rendered(scene, dp::Backend::cpu, bare, 2);
    CHECK(plain.standard_error().empty());
    CHECK(plain.layer("depth").empty());
    CHECK(std::isnan(plain.relmse_estimate()));
    CHECK(std::equal(plain.radiance().begin(), plain.radiance().end(), film.radiance().begin()));
}

TEST_CASE("A merged film has the sums, moments and first hits of all its samples") {
    const dp::Scene scene = small_scene();
    dp::Settings settings = small_settings();
    dp::Session session(scene, {}, settings);
    session.render_range(0, 8);
    dp::Film first = session.film();
    session.restart();
    session.render_range(8, 24);
    const dp::Film rest = session.film();
    session.restart();
    session.render_range(0, 32);
    const dp::Film whole = session.film();
    first.merge(rest);
    CHECK(first.info().spp == 32);
    CHECK(first.info().rays == whole.info().rays);
    CHECK(first.sample_counts() == whole.sample_counts());
    for (const char* layer : {"radiance", "standard_error", "albedo", "normal", "depth"}) {
        INFO(layer);
        const std::span<const float> a = first.layer(layer);
        const std::span<const float> b = whole.layer(layer);
        REQUIRE(a.size() == b.size());
        for (std::size_t i = 0; i < a.size(); ++i) {
            REQUIRE(a[i] == Approx(b[i]).epsilon(2e-5).margin(1e-6));
        }
    }
}

TEST_CASE("Films that do not belong together are not merged") {
    dp::Scene scene = small_scene();
    dp::Film film = of_seed(0, 4, scene);
    const dp::Film before = film;
    const auto refusal = [&](const dp::Film& other) {
        try {
            film.merge(other);
        } catch (const dp::Error& error) {
            CHECK(same_bits(film, before));
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK(refusal(film) == "film: has samples 0:4 in common with the film it is merged into");
    dp::Settings settings = small_settings();
    settings.seed = 1;
    settings.max_depth = 2;
    CHECK_THAT(refusal(rendered(scene, dp::Backend::cpu, settings, 4)), Catch::Contains("settings differ"));
    settings = small_settings();
    settings.size = {8, 8};
    CHECK_THAT(refusal(rendered(scene, dp::Backend::cpu, settings, 4)), Catch::Contains("24x16 and 8x8 pixels"));
    scene.material("red").roughness = 0.5F;
    CHECK_THAT(refusal(of_seed(1, 4, scene)), Catch::Contains("before and after an edit"));
    CHECK_THAT(refusal(of_seed(1, 4, small_scene())), Catch::Contains("different scenes"));
}

TEST_CASE("Films of two backends merge, as one estimate") {
    if (dp::devices().empty()) {
        SKIP_TEST("no Vulkan device");
    }
    const dp::Scene scene = small_scene();
    dp::Film film = of_seed(0, 4, scene);
    const std::vector<double> before = film.sums();
    dp::Settings settings = small_settings();
    settings.seed = 1;
    const dp::Film other = rendered(scene, dp::Backend::vulkan, settings, 4);
    film.merge(other);
    const std::vector<double> sums = film.sums();
    const std::vector<double> added = other.sums();
    for (std::size_t i = 0; i < sums.size(); ++i) {
        REQUIRE(sums[i] == Approx(before[i] + added[i]).epsilon(1e-12));
    }
}

TEST_CASE("A film is saved whole, and not where it cannot be") {
    const Folder folder;
    const dp::Scene scene = small_scene();
    const dp::Film film = of_seed(0, 4, scene);
    film.save(folder.file("a.exr"));
    film.save(folder.file("a.png"));
    const dp::Comparison same = dp::compare(folder.file("a.exr"), folder.file("a.exr"));
    CHECK(same.mse == 0);
    CHECK(dp::compare(folder.file("a.exr") + ":albedo", folder.file("a.exr") + ":albedo").mse == 0);
    CHECK_THROWS_AS(film.save(folder.file("a.jpeg")), dp::Error);
    CHECK_THROWS_WITH(film.save(folder.file("no/such/folder/a.exr")), Catch::Contains("a.exr"));
    for (const float value : dp::tone_mapped(film)) {
        REQUIRE(value >= 0);
        REQUIRE(value <= 1);
    }
}
