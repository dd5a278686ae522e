// Samples that are no radiance, made in the integrator, are dropped and counted.
#include "broken_light.h"

using namespace diptych::core;
using namespace diptych::core::tests;

TEST_CASE("Light samples that are NaN, infinite or negative are dropped and counted, and the rest is kept") {
    constexpr std::uint32_t spp = 8;
    const Film dark = render_cpu(packed_with_broken_light(Integrator::direct, 1, 0), spp);
    std::vector<std::uint64_t> dropped;
    for (const float bad : {std::nanf(""), HUGE_VALF, -HUGE_VALF, -1.0F}) {
        INFO(bad);
        const Film broken = render_cpu(packed_with_broken_light(Integrator::direct, 1, bad), spp);
        check_drops(broken, dark, spp);
        dropped.push_back(film_totals(broken).nonfinite);
    }
    CHECK(dropped == std::vector<std::uint64_t>(4, dropped[0]));  // the samples that the broken triangle lights
}

TEST_CASE("A NaN of a light sample survives weights, later bounces and roulette, to be counted") {
    const PackedScene broken = packed_with_broken_light(Integrator::path, 8, std::nanf(""));
    const FilmTotals totals = film_totals(render_cpu(broken, 8));
    const FilmTotals direct =
        film_totals(render_cpu(packed_with_broken_light(Integrator::direct, 1, std::nanf("")), 8));
    CHECK(totals.nonfinite > direct.nonfinite);  // each further vertex may meet it
    CHECK(totals.samples > 0);
}
