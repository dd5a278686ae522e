// What a user asks of a render; nothing here knows a backend.
#pragma once

#include <cstdint>

#include "path/integrators.h"

namespace diptych::core {

enum class Integrator { brdf, direct, path, ris, restir };
enum class BrdfModel { ggx, blinn_phong };
enum class NormalMaps { shading = 1, microfacet = 2 };  // 0 is a surface without a map
enum class SamplerKind { independent, hammersley, sobol };
enum class MisHeuristic { power, balance };
enum class LightSampler { uniform, power, spatial };
enum class ResamplingMis { pairwise, balance, one_over_z, biased_one_over_m };
enum class ResamplingVisibility { shading, target, biased_initial, biased_final };

// What an integrator does; see path/integrators.h.
inline bool samples_material(Integrator integrator) {
    return shared::samples_material(static_cast<std::uint32_t>(integrator));
}
inline bool samples_lights(Integrator integrator) {
    return shared::samples_lights(static_cast<std::uint32_t>(integrator));
}
inline bool resamples(Integrator integrator) {
    return shared::resamples_lights(static_cast<std::uint32_t>(integrator));
}
inline bool reuses(Integrator integrator) {
    return shared::reuses_reservoirs(static_cast<std::uint32_t>(integrator));
}

/// How `ris` and `restir` resample; see ResamplingConstants in shared_glsl_cpp/language/scene_types.h.
struct ResamplingSettings {
    std::uint32_t light_candidates = 8;
    float near_share = 0.5F;  // of them, rounded down: picked by power times cosine over the square of the distance
    bool bsdf_candidate = true;
    bool temporal = true;
    std::uint32_t spatial_passes = 1;
    std::uint32_t neighbors = 4;
    float radius = 16;  // pixels
    float confidence_cap = 4;
    ResamplingMis mis = ResamplingMis::pairwise;
    ResamplingVisibility visibility = ResamplingVisibility::shading;

    bool operator==(const ResamplingSettings&) const = default;
};

struct RenderSettings {
    int width = 512;
    int height = 512;
    Integrator integrator = Integrator::path;
    BrdfModel brdf = BrdfModel::ggx;
    NormalMaps normal_maps = NormalMaps::shading;
    SamplerKind sampler = SamplerKind::sobol;
    MisHeuristic mis = MisHeuristic::power;
    LightSampler light_sampler = LightSampler::spatial;
    std::uint32_t max_depth = 8;  // scattering events; 1 is emission plus direct light
    std::uint32_t seed = 0;
    std::uint32_t sample_count = 64;  // samples a pixel that a Hammersley set is laid out for
    int camera = 0;                   // index into the scene's cameras
    bool standard_error = false;      // keep second moments
    bool first_hit_layers = false;    // keep albedo, normal, depth
    bool generic = false;             // leave nothing out: every feature on
    bool moves = false;               // the scene has other moments, which reuse will look back to
    std::uint32_t atlas_tile = 0;  // ris and restir: pixels of the side of isolated copies of the view; 0 is one view
    ResamplingSettings resampling;

    bool operator==(const RenderSettings&) const = default;
};

/// Whether frames reuse what those before them found, so that they go on from one another and their samples depend on
/// one another.
inline bool chains_frames(const RenderSettings& settings) {
    return reuses(settings.integrator) && settings.resampling.temporal;
}

}  // namespace diptych::core
