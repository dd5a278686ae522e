// What a scene and its settings need, derived once.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "settings/settings.h"
#include "scene/scene.h"

namespace diptych::core {

/// Whether a material's emission can be anything but zero, at any moment.
bool emits(const Material& material);

/// FEATURE_… bits (scene_features.h) that this render needs; every bit where settings.generic.
std::uint32_t needed_features(const Scene& scene, const RenderSettings& settings);

/// The command line's names of the bits that are set, in the order of their list.
std::vector<std::string> feature_names(std::uint32_t features);

}  // namespace diptych::core
