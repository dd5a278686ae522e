#include <algorithm>

#include "error.h"
#include "numbers/sampler.h"
#include "pack/pack_parts.h"

namespace diptych::core {
namespace {

// pack_settings hands these over by their numbers.
#define ASSERT_SAME(value, constant) static_assert(static_cast<std::uint32_t>(value) == shared::constant)
ASSERT_SAME(Integrator::brdf, INTEGRATOR_BRDF);
ASSERT_SAME(Integrator::direct, INTEGRATOR_DIRECT);
ASSERT_SAME(Integrator::path, INTEGRATOR_PATH);
ASSERT_SAME(Integrator::ris, INTEGRATOR_RIS);
ASSERT_SAME(Integrator::restir, INTEGRATOR_RESTIR);
ASSERT_SAME(BrdfModel::ggx, BRDF_GGX);
ASSERT_SAME(BrdfModel::blinn_phong, BRDF_BLINN_PHONG);
ASSERT_SAME(NormalMaps::shading, NORMAL_MAP_SHADING);
ASSERT_SAME(NormalMaps::microfacet, NORMAL_MAP_MICROFACET);
ASSERT_SAME(SamplerKind::independent, SAMPLER_INDEPENDENT);
ASSERT_SAME(SamplerKind::hammersley, SAMPLER_HAMMERSLEY);
ASSERT_SAME(SamplerKind::sobol, SAMPLER_SOBOL);
ASSERT_SAME(MisHeuristic::power, MIS_POWER);
ASSERT_SAME(MisHeuristic::balance, MIS_BALANCE);
ASSERT_SAME(LightSampler::uniform, LIGHT_SAMPLER_UNIFORM);
ASSERT_SAME(LightSampler::power, LIGHT_SAMPLER_POWER);
ASSERT_SAME(LightSampler::spatial, LIGHT_SAMPLER_SPATIAL);
ASSERT_SAME(ResamplingMis::pairwise, RESAMPLING_PAIRWISE);
ASSERT_SAME(ResamplingMis::balance, RESAMPLING_BALANCE);
ASSERT_SAME(ResamplingMis::one_over_z, RESAMPLING_ONE_OVER_Z);
ASSERT_SAME(ResamplingMis::biased_one_over_m, RESAMPLING_BIASED_ONE_OVER_M);
ASSERT_SAME(ResamplingVisibility::shading, VISIBILITY_IN_SHADING);
ASSERT_SAME(ResamplingVisibility::target, VISIBILITY_IN_TARGET);
ASSERT_SAME(ResamplingVisibility::biased_initial, VISIBILITY_BIASED_INITIAL);
ASSERT_SAME(ResamplingVisibility::biased_final, VISIBILITY_BIASED_FINAL);
#undef ASSERT_SAME

}  // namespace

void check_atlas(const RenderSettings& settings) {
    const auto tile = static_cast<int>(settings.atlas_tile);
    if (tile == 0) {
        return;
    }
    if (!resamples(settings.integrator)) {
        throw Error("`atlas` " + std::to_string(tile) + ": goes with `integrator` ris or restir");
    }
    if (settings.width % tile != 0 || settings.height % tile != 0) {
        throw Error("`atlas` " + std::to_string(tile) + ": does not divide the size of " +
                    std::to_string(settings.width) + "x" + std::to_string(settings.height));
    }
}

void pack_settings(const RenderSettings& settings, shared::RenderConstants& c) {
    c.size = {static_cast<std::uint32_t>(settings.width), static_cast<std::uint32_t>(settings.height)};
    c.seed = settings.seed;
    c.sampler_kind = static_cast<std::uint32_t>(settings.sampler);
    c.sample_count = settings.sample_count;
    c.max_depth = settings.max_depth;
    c.integrator = static_cast<std::uint32_t>(settings.integrator);
    c.brdf = static_cast<std::uint32_t>(settings.brdf);
    c.normal_maps = static_cast<std::uint32_t>(settings.normal_maps);
    c.mis = static_cast<std::uint32_t>(settings.mis);
    c.light_sampler = static_cast<std::uint32_t>(settings.light_sampler);
    c.atlas_tile = settings.atlas_tile;
    const ResamplingSettings& from = settings.resampling;
    c.resampling.light_candidates = from.light_candidates;
    // One pick at least goes to what has no place.
    c.resampling.near_candidates =
        std::min(static_cast<std::uint32_t>(from.near_share * static_cast<float>(from.light_candidates)),
                 std::max(from.light_candidates, 1U) - 1);
    c.resampling.bsdf_candidates = from.bsdf_candidate ? 1 : 0;
    c.resampling.temporal = from.temporal ? 1 : 0;
    c.resampling.spatial_passes = from.spatial_passes;
    c.resampling.neighbors = std::min(from.neighbors, shared::RESAMPLING_MAX_NEIGHBORS);
    c.resampling.radius = from.radius;
    c.resampling.confidence_cap = from.confidence_cap;
    c.resampling.mis = static_cast<std::uint32_t>(from.mis);
    c.resampling.visibility = static_cast<std::uint32_t>(from.visibility);
}

}  // namespace diptych::core
