#include "diptych/settings.h"

#include <array>

#include "backends/backends.h"
#include "library/impl.h"
#include "near_miss.h"
#include "settings/names.h"

DIPTYCH_BEGIN

static_assert(static_cast<int>(core::Integrator::restir) == static_cast<int>(Integrator::restir));
static_assert(static_cast<int>(core::BrdfModel::blinn_phong) == static_cast<int>(BrdfModel::blinn_phong));
static_assert(static_cast<int>(core::NormalMaps::microfacet) == static_cast<int>(NormalMaps::microfacet) + 1);
static_assert(static_cast<int>(core::SamplerKind::sobol) == static_cast<int>(SamplerKind::sobol));
static_assert(static_cast<int>(core::MisHeuristic::balance) == static_cast<int>(MisHeuristic::balance));
static_assert(static_cast<int>(core::LightSampler::spatial) == static_cast<int>(LightSampler::spatial));
static_assert(static_cast<int>(core::ResamplingMis::biased_one_over_m) ==
              static_cast<int>(ResamplingMis::biased_one_over_m));
static_assert(static_cast<int>(core::ResamplingVisibility::biased_final) ==
              static_cast<int>(ResamplingVisibility::biased_final));

core::RenderSettings to_core(const Settings& s) {
    core::RenderSettings out;
    out.width = s.size[0];
    out.height = s.size[1];
    out.integrator = static_cast<core::Integrator>(s.integrator);
    out.brdf = static_cast<core::BrdfModel>(s.brdf);
    out.normal_maps = static_cast<core::NormalMaps>(static_cast<int>(s.normal_maps) + 1);
    out.sampler = static_cast<core::SamplerKind>(s.sampler);
    out.mis = static_cast<core::MisHeuristic>(s.mis);
    out.light_sampler = static_cast<core::LightSampler>(s.light_sampler);
    out.max_depth = s.max_depth;
    out.seed = s.seed;
    out.sample_count = s.sample_count;
    out.camera = s.camera;
    out.standard_error = s.standard_error;
    out.first_hit_layers = s.first_hit;
    const ResamplingSettings& r = s.resampling;
    out.resampling = {r.light_candidates,
                      r.near_share,
                      r.bsdf_candidate,
                      r.temporal,
                      r.spatial_passes,
                      r.neighbors,
                      r.radius,
                      r.confidence_cap,
                      static_cast<core::ResamplingMis>(r.mis),
                      static_cast<core::ResamplingVisibility>(r.visibility)};
    return out;
}

Settings from_core(const core::RenderSettings& s) {
    Settings out;
    out.size = {s.width, s.height};
    out.integrator = static_cast<Integrator>(s.integrator);
    out.brdf = static_cast<BrdfModel>(s.brdf);
    out.normal_maps = static_cast<NormalMaps>(static_cast<int>(s.normal_maps) - 1);
    out.sampler = static_cast<SamplerKind>(s.sampler);
    out.mis = static_cast<MisHeuristic>(s.mis);
    out.light_sampler = static_cast<LightSampler>(s.light_sampler);
    out.max_depth = s.max_depth;
    out.seed = s.seed;
    out.sample_count = s.sample_count;
    out.camera = s.camera;
    out.standard_error = s.standard_error;
    out.first_hit = s.first_hit_layers;
    const core::ResamplingSettings& r = s.resampling;
    out.resampling = {r.light_candidates,
                      r.near_share,
                      r.bsdf_candidate,
                      r.temporal,
                      r.spatial_passes,
                      r.neighbors,
                      r.radius,
                      r.confidence_cap,
                      static_cast<ResamplingMis>(r.mis),
                      static_cast<ResamplingVisibility>(r.visibility)};
    return out;
}

std::string core_name(Backend backend) {
    return core::app::backend_names().at(static_cast<std::size_t>(backend));
}

std::string name_of(Backend backend) {
    return core_name(backend);
}

std::string name_of(Integrator integrator) {
    return core::name_of(static_cast<core::Integrator>(integrator));
}

Backend backend_from(const std::string& name) {
    const std::vector<std::string> names = core::app::backend_names();
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (names[i] == name) {
            return static_cast<Backend>(i);
        }
    }
    throw SettingError("no backend '" + name + "'" + core::did_you_mean(name, names) +
                       "; there are only cpu, vulkan, oracle");
}

Integrator integrator_from(const std::string& name) {
    try {
        return static_cast<Integrator>(core::integrator_from_name(name));
    } catch (const core::Error& error) {
        throw SettingError(error.what());
    }
}

std::vector<std::string> devices() {
    return guarded([] { return core::app::usable_devices(); });
}

DIPTYCH_END
