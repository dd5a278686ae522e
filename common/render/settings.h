// What a user asks of a render; nothing here knows a backend.
#pragma once

#include <cstdint>

namespace diptych {

enum class Integrator { brdf, direct, path };
enum class BrdfModel { ggx, blinn_phong };
enum class SamplerKind { independent, hammersley, sobol };
enum class MisHeuristic { power, balance };

struct RenderSettings {
    int width = 512;
    int height = 512;
    Integrator integrator = Integrator::path;
    BrdfModel brdf = BrdfModel::ggx;
    SamplerKind sampler = SamplerKind::sobol;
    MisHeuristic mis = MisHeuristic::power;
    std::uint32_t max_depth = 8;       // scattering events; 1 is emission plus direct light
    std::uint32_t seed = 0;
    std::uint32_t sample_count = 64;   // samples a pixel that a Hammersley set is laid out for
    int camera = 0;                    // index into the scene's cameras
    bool standard_error = false;       // keep second moments
    bool first_hit_layers = false;     // keep albedo, normal, depth
    bool generic = false;              // leave nothing out: every feature on
    bool moves = false;                // the scene has other moments, which reuse will look back to
};

}  // namespace diptych
