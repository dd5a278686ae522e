#include "random_scene/parts.h"

namespace diptych::core {

void draw_settings(RenderSettings& settings, bool in_room, Draws draws) {
    settings.integrator =
        draws.pick({Integrator::brdf, Integrator::direct, Integrator::path, Integrator::ris, Integrator::restir});
    settings.brdf = draws.pick({BrdfModel::ggx, BrdfModel::blinn_phong});
    settings.normal_maps = draws.chance(0.7) ? NormalMaps::shading : NormalMaps::microfacet;
    settings.sampler = draws.pick({SamplerKind::independent, SamplerKind::sobol});
    settings.mis = draws.pick({MisHeuristic::power, MisHeuristic::balance});
    settings.max_depth = in_room ? draws.pick({2U, 6U, 12U}) : draws.pick({1U, 1U, 2U, 3U, 6U, 12U});
    settings.generic = draws.chance(0.3);
    ResamplingSettings& resampling = settings.resampling;
    resampling.light_candidates = draws.pick({1U, 4U, 8U, 16U});
    resampling.near_share = draws.pick({0.0F, 0.5F, 1.0F});
    resampling.bsdf_candidate = draws.chance(0.8);
    resampling.temporal = draws.chance(0.7);
    resampling.spatial_passes = draws.pick({0U, 1U, 1U, 2U});
    resampling.neighbors = draws.pick({1U, 3U, 4U});
    resampling.radius = draws.pick({3.0F, 8.0F});
    resampling.confidence_cap = draws.pick({2.0F, 4.0F, 20.0F});
    resampling.mis = draws.pick({ResamplingMis::pairwise, ResamplingMis::pairwise, ResamplingMis::balance});
    resampling.visibility = draws.pick({ResamplingVisibility::shading, ResamplingVisibility::target});
    // Seldom `uniform`: its noise leaves less of the samples for finding a bias.
    settings.light_sampler = draws.pick({LightSampler::spatial, LightSampler::spatial, LightSampler::spatial,
                                         LightSampler::power, LightSampler::power, LightSampler::uniform});
}

}  // namespace diptych::core
