// Names of the settings' choices, for command lines, files and interfaces.
#pragma once

#include <string>

#include "settings/settings.h"

namespace diptych::core {

const char* name_of(Integrator integrator);
const char* name_of(BrdfModel brdf);
const char* name_of(NormalMaps model);
const char* name_of(SamplerKind sampler);
const char* name_of(MisHeuristic mis);
const char* name_of(LightSampler sampler);
const char* name_of(ResamplingMis mis);
const char* name_of(ResamplingVisibility visibility);

/// Each throws Error, listing the names there are, where none is `name`.
Integrator integrator_from_name(const std::string& name);
BrdfModel brdf_from_name(const std::string& name);
NormalMaps normal_maps_from_name(const std::string& name);
SamplerKind sampler_from_name(const std::string& name);
MisHeuristic mis_from_name(const std::string& name);
LightSampler light_sampler_from_name(const std::string& name);
ResamplingMis resampling_mis_from_name(const std::string& name);
ResamplingVisibility resampling_visibility_from_name(const std::string& name);

}  // namespace diptych::core
