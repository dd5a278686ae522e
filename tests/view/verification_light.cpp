// The running test between the panels, and the history of an estimated error.
#include "view/verification_light.h"

#include <cmath>
#include <random>

#include "catch.h"
#include "view/film_figures.h"

using namespace diptych::core;
using namespace diptych::core::app;

namespace {

PanelShot shot_of(double mean, double error, std::uint32_t spp = 64) {
    PanelShot shot;
    shot.figures.version = 3;
    shot.figures.spp = spp;
    shot.figures.width = 8;
    shot.figures.height = 8;
    shot.figures.mean = {mean, mean, mean};
    shot.figures.standard_error = Rgb{error, error, error};
    return shot;
}

/// Samples of that mean and of standard deviation 1, in every pixel and channel.
Film noise(double mean, int samples, std::uint32_t seed) {
    Film film;
    film.width = 8;
    film.height = 4;
    film.pixels.resize(32);
    film.moments.resize(32);
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(-std::sqrt(3.0F), std::sqrt(3.0F));
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        for (int s = 0; s < samples; ++s) {
            const glm::vec3 x =
                glm::vec3(static_cast<float>(mean)) + glm::vec3(uniform(random), uniform(random), uniform(random));
            REQUIRE(shared::film_add(film.pixels[i], x, 2));
            shared::film_add_moments(film.moments[i], x);
        }
    }
    return film;
}

}  // namespace

TEST_CASE("The light waits for the same picture and enough samples", "[view]") {
    CHECK(verification_light(PanelShot{}, PanelShot{}).agreement == Agreement::waiting);
    CHECK(verification_light(shot_of(1, 0.1, 15), shot_of(1, 0.1)).agreement == Agreement::waiting);
    CHECK(verification_light(shot_of(1, 0.1), shot_of(1, 0.1, 15)).agreement == Agreement::waiting);
    PanelShot other = shot_of(1, 0.1);
    other.figures.version = 4;
    CHECK(verification_light(shot_of(1, 0.1), other).agreement == Agreement::waiting);
    other = shot_of(1, 0.1);
    other.figures.width = 4;
    CHECK(verification_light(shot_of(1, 0.1), other).agreement == Agreement::waiting);
    CHECK(verification_light(shot_of(1, 0.1, 16), shot_of(1, 0.1, 16)).agreement == Agreement::agree);
}

TEST_CASE("The light tells agreement from difference", "[view]") {
    const double both = 0.1 * std::sqrt(2.0);
    CHECK(verification_light(shot_of(5, 0.1), shot_of(5 + 2.9 * both, 0.1)).agreement == Agreement::agree);
    CHECK(verification_light(shot_of(5, 0.1), shot_of(5 + 3.1 * both, 0.1)).agreement == Agreement::doubtful);
    const VerificationLight far = verification_light(shot_of(5, 0.1), shot_of(5 + 4.6 * both, 0.1));
    CHECK(far.agreement == Agreement::differ);
    CHECK(far.z[0] == Approx(-4.6).epsilon(1e-3));
    CHECK(far.text == "z = 4.6: differ");
    CHECK(far.p == Approx(3 * std::erfc(4.6 / std::sqrt(2.0))).epsilon(1e-3));
    // One channel is enough.
    PanelShot green = shot_of(5, 0.1);
    green.figures.mean[1] = 6;
    CHECK(verification_light(shot_of(5, 0.1), green).agreement == Agreement::differ);
    // Two compilers' rounding of the same constant is no difference.
    CHECK(verification_light(shot_of(1, 0), shot_of(1 + 1e-6, 0)).agreement == Agreement::agree);
}

TEST_CASE("Chains have no running test", "[view]") {
    PanelShot chain = shot_of(1, 0.1);
    chain.correlated = true;
    CHECK(verification_light(chain, shot_of(9, 0.1)).agreement == Agreement::correlated);
}

TEST_CASE("Figures of a film are its mean and how well that is known", "[view]") {
    int beyond = 0;
    constexpr int films = 200;
    for (std::uint32_t seed = 0; seed < films; ++seed) {
        const FilmFigures figures = film_figures(noise(3, 20, seed), 7, 20);
        REQUIRE(figures.standard_error);
        CHECK((*figures.standard_error)[0] == Approx(1 / std::sqrt(32.0 * 20)).epsilon(0.2));
        beyond += std::abs(figures.mean[0] - 3) > 1.96 * (*figures.standard_error)[0] ? 1 : 0;
        CHECK(figures.rays == 32 * 20 * 2);
        CHECK(figures.relmse);
    }
    CHECK(beyond > 1);  // 10 expected
    CHECK(beyond < 25);
    Film plain = noise(3, 20, 1);
    plain.moments.clear();
    CHECK(!film_figures(plain, 7, 20).standard_error);
    CHECK(!film_figures(noise(3, 1, 1), 7, 1).standard_error);
}

TEST_CASE("Two films of one mean agree, of two means do not", "[view]") {
    PanelShot a;
    PanelShot b;
    a.figures = film_figures(noise(3, 200, 1), 7, 200);
    b.figures = film_figures(noise(3, 200, 2), 7, 200);
    CHECK(verification_light(a, b).agreement == Agreement::agree);
    b.figures = film_figures(noise(3.2, 200, 2), 7, 200);
    CHECK(verification_light(a, b).agreement == Agreement::differ);
}

TEST_CASE("The history of the error begins anew with the picture and keeps its length", "[view]") {
    ErrorHistory history(4);
    PanelShot shot = shot_of(1, 0.1, 1);
    shot.figures.relmse = 1;
    history.add(shot, 100);
    CHECK(history.points().empty());  // of one sample nothing is known
    for (std::uint32_t spp = 2; spp < 9; ++spp) {
        shot.figures.spp = spp;
        shot.figures.relmse = 1.0 / spp;
        history.add(shot, 100 + spp);
        history.add(shot, 100.5 + spp);  // nothing new
    }
    REQUIRE(history.points().size() == 4);
    CHECK(history.points().front().spp == 5);
    CHECK(history.points().back().seconds == Approx(8));
    CHECK(history.points().back().relmse == Approx(1.0 / 8));
    shot.figures.version = 9;
    shot.figures.spp = 2;
    history.add(shot, 200);
    REQUIRE(history.points().size() == 1);
    CHECK(history.points().back().seconds == 0);
}
