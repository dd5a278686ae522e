// What resampling may need beyond what it does need changes nothing.
#include "chain_cases.h"

namespace diptych::core::tests {

TEST_CASE("Every feature allowed gives the rays and the picture of those that are needed, whatever asks for visibility") {
    for (const auto visibility : {ResamplingVisibility::shading, ResamplingVisibility::target, ResamplingVisibility::biased_initial,
                                  ResamplingVisibility::biased_final}) {
        RenderSettings settings = statistical_settings(16, 12, Integrator::restir, 1);
        settings.resampling.visibility = visibility;
        const Film needed = render_cpu(slats(false), settings, 3);
        settings.generic = true;
        const Film all = render_cpu(slats(false), settings, 3);
        CAPTURE(static_cast<int>(visibility));
        CHECK(film_totals(all).rays == film_totals(needed).rays);
        CHECK(same_film(all, needed));
    }
}

}  // namespace diptych::core::tests
