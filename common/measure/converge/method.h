// What a measurement of convergence is to render, and how far it is to go.
#pragma once

#include <cstdint>
#include <string>

#include "render/metadata.h"
#include "render/request.h"
#include "render/seeds.h"

namespace diptych::core {

struct ConvergeSettings {
    std::uint32_t runs = 16;      // of each method
    std::uint32_t spp_max = 256;  // of a run: the power of two that is not above it
    double seconds = 0;           // above 0: as many samples, a power of two, as each method renders in so long
    double picture_seconds = 0;   // that the pictures compare; 0: as long as the fastest method's whole run
    double target_relmse = 0;     // to which times are told; 0: what half of the methods reach
    PictureMaker maker;           // what its pictures say that made them
};

/// Blocks of a reference that is rendered: each has a seed of its own and as many samples as the longest run of any
/// method, so their mean has 16 times as many, and their spread says how far it is off, whatever the sampler.
inline constexpr std::uint32_t reference_blocks = 16;

/// One way of rendering the scene.
struct Method {
    std::string name;       // BACKEND:INTEGRATOR or BACKEND:INTEGRATOR:SAMPLER, as asked for
    RenderRequest request;  // with the seed of run 0
    SeedPlan seeds;
    std::uint32_t place = 0;         // among the sides of `seeds`
    std::uint32_t picture_seed = 0;  // of its picture, which is no run

    /// Of a run, or of a block of a reference. All counts of samples of a run share it: they are one unit of the
    /// statistics.
    std::uint32_t seed_of(std::uint32_t run) const { return seeds.seed(place, run); }

    bool chained() const { return request.backend != "oracle" && request.settings.integrator == Integrator::restir; }
    bool laid_out() const { return request.backend != "oracle" && request.settings.sampler == SamplerKind::hammersley; }
};

/// ':' and '/' become '-'.
std::string file_stem(const std::string& method);

}  // namespace diptych::core
