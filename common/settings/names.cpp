#include "settings/names.h"

#include <fmt/format.h>

#include "error.h"

namespace diptych::core {

namespace {

template <typename T>
struct Choice {
    const char* name;
    T value;
};

constexpr Choice<Integrator> integrators[] = {{"brdf", Integrator::brdf},
                                              {"direct", Integrator::direct},
                                              {"path", Integrator::path},
                                              {"ris", Integrator::ris},
                                              {"restir", Integrator::restir}};
constexpr Choice<ResamplingMis> resampling_mis[] = {{"pairwise", ResamplingMis::pairwise},
                                                    {"balance", ResamplingMis::balance},
                                                    {"1-over-z", ResamplingMis::one_over_z},
                                                    {"biased-1-over-m", ResamplingMis::biased_one_over_m}};
constexpr Choice<ResamplingVisibility> resampling_visibility[] = {
    {"shading", ResamplingVisibility::shading},
    {"target", ResamplingVisibility::target},
    {"biased-initial", ResamplingVisibility::biased_initial},
    {"biased-final", ResamplingVisibility::biased_final}};
constexpr Choice<BrdfModel> brdfs[] = {{"ggx", BrdfModel::ggx}, {"blinn-phong", BrdfModel::blinn_phong}};
constexpr Choice<NormalMaps> normal_maps[] = {{"shading", NormalMaps::shading}, {"microfacet", NormalMaps::microfacet}};
constexpr Choice<SamplerKind> samplers[] = {
    {"independent", SamplerKind::independent}, {"hammersley", SamplerKind::hammersley}, {"sobol", SamplerKind::sobol}};
constexpr Choice<LightSampler> light_samplers[] = {
    {"uniform", LightSampler::uniform}, {"power", LightSampler::power}, {"spatial", LightSampler::spatial}};
constexpr Choice<MisHeuristic> heuristics[] = {{"power", MisHeuristic::power}, {"balance", MisHeuristic::balance}};

template <typename T, std::size_t N>
const char* name_in(const Choice<T> (&choices)[N], T value) {
    for (const Choice<T>& choice : choices) {
        if (choice.value == value) {
            return choice.name;
        }
    }
    return "unknown";
}

template <typename T, std::size_t N>
T value_in(const Choice<T> (&choices)[N], const char* setting, const std::string& name) {
    std::string names;
    for (const Choice<T>& choice : choices) {
        if (name == choice.name) {
            return choice.value;
        }
        names += names.empty() ? "" : ", ";
        names += choice.name;
    }
    throw Error(fmt::format("`{}` {}: there are only {}", setting, name, names));
}

}  // namespace

const char* name_of(Integrator integrator) {
    return name_in(integrators, integrator);
}
const char* name_of(BrdfModel brdf) {
    return name_in(brdfs, brdf);
}
const char* name_of(NormalMaps model) {
    return name_in(normal_maps, model);
}
const char* name_of(SamplerKind sampler) {
    return name_in(samplers, sampler);
}
const char* name_of(MisHeuristic mis) {
    return name_in(heuristics, mis);
}
const char* name_of(LightSampler sampler) {
    return name_in(light_samplers, sampler);
}
const char* name_of(ResamplingMis mis) {
    return name_in(resampling_mis, mis);
}
const char* name_of(ResamplingVisibility visibility) {
    return name_in(resampling_visibility, visibility);
}

Integrator integrator_from_name(const std::string& name) {
    return value_in(integrators, "integrator", name);
}
BrdfModel brdf_from_name(const std::string& name) {
    return value_in(brdfs, "brdf", name);
}
NormalMaps normal_maps_from_name(const std::string& name) {
    return value_in(normal_maps, "normal_maps", name);
}
SamplerKind sampler_from_name(const std::string& name) {
    return value_in(samplers, "sampler", name);
}
ResamplingMis resampling_mis_from_name(const std::string& name) {
    return value_in(resampling_mis, "reuse_mis", name);
}
ResamplingVisibility resampling_visibility_from_name(const std::string& name) {
    return value_in(resampling_visibility, "reuse_visibility", name);
}
MisHeuristic mis_from_name(const std::string& name) {
    return value_in(heuristics, "mis", name);
}
LightSampler light_sampler_from_name(const std::string& name) {
    return value_in(light_samplers, "light_sampler", name);
}

}  // namespace diptych::core
