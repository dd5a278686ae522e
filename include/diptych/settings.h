// How a scene is rendered.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "diptych/export.h"

DIPTYCH_BEGIN

/// The oracle is a third renderer that shares no shading code with the other two. It heeds no integrator.
enum class Backend { cpu, vulkan, oracle };

enum class Integrator { brdf, direct, path, ris, restir };
enum class BrdfModel { ggx, blinn_phong };
enum class NormalMaps { shading, microfacet };
enum class SamplerKind { independent, hammersley, sobol };
enum class MisHeuristic { power, balance };
enum class LightSampler { uniform, power, spatial };
enum class ResamplingMis { pairwise, balance, one_over_z, biased_one_over_m };
enum class ResamplingVisibility { shading, target, biased_initial, biased_final };

/// A session refuses options of another backend.
struct BackendChoice {
    Backend backend = Backend::cpu;
    std::string device;       // vulkan: an index or a part of the name; empty is the best
    int threads = 0;          // cpu, oracle; 0 is one a core
    bool validation = false;  // vulkan: the validation layers
};

/// Of `ris` and `restir`; docs/restir.md defines each. The ranges are those that `diptych render --help` lists.
struct ResamplingSettings {
    std::uint32_t light_candidates = 8;
    float near_share = 0.5F;  // 0 to 1
    bool bsdf_candidate = true;
    bool temporal = true;
    std::uint32_t spatial_passes = 1;
    std::uint32_t neighbors = 4;
    float radius = 16;         // pixels
    float confidence_cap = 4;  // of the frame before, in frames
    ResamplingMis mis = ResamplingMis::pairwise;
    ResamplingVisibility visibility = ResamplingVisibility::shading;

    bool operator==(const ResamplingSettings&) const = default;
};

struct Settings {
    Integrator integrator = Integrator::path;
    std::array<int, 2> size = {512, 512};  // width, height; 1 to 65536 pixels
    std::uint32_t max_depth = 8;           // scattering events, 0 to 65535: 1 is emission and direct light
    std::uint32_t seed = 0;
    int camera = 0;  // index into Scene::cameras
    SamplerKind sampler = SamplerKind::sobol;
    std::uint32_t sample_count = 64;  // samples a pixel that a Hammersley set is laid out for
    MisHeuristic mis = MisHeuristic::power;
    LightSampler light_sampler = LightSampler::spatial;  // how path and direct pick a light
    BrdfModel brdf = BrdfModel::ggx;
    NormalMaps normal_maps = NormalMaps::shading;
    bool standard_error = true;  // keep second moments
    bool first_hit = true;       // keep albedo, normal and depth
    ResamplingSettings resampling;

    bool operator==(const Settings&) const = default;
};

/// As the command line spells them: "cpu", "restir".
DIPTYCH_EXPORT std::string name_of(Backend backend);
DIPTYCH_EXPORT std::string name_of(Integrator integrator);

/// The inverse. Throws Error with the names that there are.
DIPTYCH_EXPORT Backend backend_from(const std::string& name);
DIPTYCH_EXPORT Integrator integrator_from(const std::string& name);

/// The Vulkan devices that can render, best first; empty where there are none.
DIPTYCH_EXPORT std::vector<std::string> devices();

DIPTYCH_END
