#include "catch.h"

#include <cmath>
#include <random>
#include <vector>

#include "render/film.h"
#include "render/film_statistics.h"

using namespace diptych::core;

namespace {

/// A film of one row whose pixel i has had the samples i.
Film film_of(const std::vector<std::vector<glm::vec3>>& samples) {
    Film film;
    film.width = static_cast<int>(samples.size());
    film.height = 1;
    film.pixels.resize(samples.size());
    film.moments.resize(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        for (const glm::vec3& sample : samples[i]) {
            if (shared::film_add(film.pixels[i], sample, 2)) {
                shared::film_add_moments(film.moments[i], sample);
            }
        }
    }
    return film;
}

}  // namespace

TEST_CASE("develop gives means and standard errors of known numbers", "[render]") {
    const Film film = film_of({{{1, 2, 0}, {3, 2, 0}, {5, 2, 3}}, {{7, 7, 7}}, {}});
    const LayeredImage layers = develop(film);
    REQUIRE(layers.standard_error);
    CHECK(layers.color.at(0, 0, 0) == 3);
    CHECK(layers.color.at(0, 0, 1) == 2);
    CHECK(layers.color.at(0, 0, 2) == 1);
    // s^2 = ((-2)^2 + 0 + 2^2) / 2 = 4, and ((-1)^2 + (-1)^2 + 2^2) / 2 = 3.
    CHECK(layers.standard_error->at(0, 0, 0) == Approx(std::sqrt(4.0 / 3)));
    CHECK(layers.standard_error->at(0, 0, 1) == 0);
    CHECK(layers.standard_error->at(0, 0, 2) == Approx(1));
    CHECK(layers.color.at(1, 0, 0) == 7);
    CHECK(std::isnan(layers.standard_error->at(1, 0, 0)));  // one sample says nothing of its error
    CHECK(layers.color.at(2, 0, 0) == 0);
    CHECK_FALSE(layers.albedo);
    CHECK_FALSE(layers.depth);
}

TEST_CASE("develop keeps small variance beside a large mean", "[render]") {
    std::mt19937 random(1);
    std::normal_distribution<float> normal(1000, 0.5F);
    std::vector<glm::vec3> samples;
    double sum = 0;
    for (int i = 0; i < 20000; ++i) {
        samples.emplace_back(normal(random));
        sum += samples.back().x;
    }
    const double mean = sum / static_cast<double>(samples.size());
    double squares = 0;
    for (const glm::vec3& sample : samples) {
        squares += (sample.x - mean) * (sample.x - mean);
    }
    const double n = static_cast<double>(samples.size());
    const LayeredImage layers = develop(film_of({samples}));
    CHECK(layers.color.at(0, 0, 0) == Approx(mean).epsilon(1e-7));
    CHECK(layers.standard_error->at(0, 0, 0) == Approx(std::sqrt(squares / (n - 1) / n)).epsilon(1e-4));
}

TEST_CASE("dropped samples count as none in colour and as misses of nothing in totals", "[render]") {
    const float nan = std::nanf("");
    const Film film = film_of({{{1, 1, 1}, {nan, 1, 1}, {3, 3, 3}}, {{INFINITY, 0, 0}, {0, -1, 0}}});
    const FilmTotals totals = film_totals(film);
    CHECK(totals.samples == 2);
    CHECK(totals.nonfinite == 3);
    CHECK(totals.rays == 10);
    const LayeredImage layers = develop(film);
    CHECK(layers.color.at(0, 0, 0) == 2);
    CHECK(layers.color.at(1, 0, 0) == 0);
}

TEST_CASE("first-hit layers are means over all samples, dropped ones included", "[render]") {
    Film film = film_of({{{1, 1, 1}, {std::nanf(""), 1, 1}}});
    film.first_hits.resize(1);
    const shared::FirstHit near{glm::vec3(0.5F), glm::vec3(0, 0, 1), 2};
    const shared::FirstHit far{glm::vec3(1.0F), glm::vec3(0, 1, 0), 4};
    shared::film_add_first_hit(film.first_hits[0], near);
    shared::film_add_first_hit(film.first_hits[0], far);
    const LayeredImage layers = develop(film);
    REQUIRE(layers.albedo);
    CHECK(layers.albedo->at(0, 0, 1) == 0.75F);
    CHECK(layers.normal->at(0, 0, 1) == 0.5F);
    CHECK(layers.normal->at(0, 0, 2) == 0.5F);
    CHECK(layers.depth->at(0, 0, 0) == 3);
}

TEST_CASE("the estimated relMSE is that of the pixels whose error is known", "[render]") {
    const Film film = film_of({{{1, 1, 1}, {3, 3, 3}}, {{9, 9, 9}}});
    REQUIRE(estimated_relmse(film));
    CHECK(*estimated_relmse(film) == Approx(1 / 4.01));  // se^2 = 2 / 2, mean 2
    CHECK_FALSE(estimated_relmse(film_of({{{9, 9, 9}}})));
    Film without = film;
    without.moments.clear();
    CHECK_FALSE(estimated_relmse(without));
}
