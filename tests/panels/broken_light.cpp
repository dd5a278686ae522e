// Both panels drop and count what is no radiance, and the same of it.
#include "../cpu/broken_light.h"
#include "panels_fixture.h"

using namespace diptych::core;
using namespace diptych::core::tests;

TEST_CASE("Both panels drop and count NaN and negative light samples, and agree on how many") {
    NEED_VULKAN();
    constexpr std::uint32_t spp = 8;
    const Film dark = render_vulkan(packed_with_broken_light(Integrator::direct, 1, 0), spp);
    for (const float bad : {std::nanf(""), -1.0F}) {
        INFO(bad);
        const PackedScene packed = packed_with_broken_light(Integrator::direct, 1, bad);
        const Film vulkan = render_vulkan(packed, spp);
        check_drops(vulkan, dark, spp);
        const auto cpu = static_cast<double>(film_totals(render_cpu(packed, spp)).nonfinite);
        CHECK(static_cast<double>(film_totals(vulkan).nonfinite) ==
              Approx(cpu).epsilon(0.005));  // but for rays at edges
    }
}
