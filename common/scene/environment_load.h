// Light from infinity: environment maps from files, and the sky for scenes that have no light.
#pragma once

#include <cstdint>
#include <string>

#include "scene/scene.h"

namespace diptych::core {

/// Reads an equirectangular map as linear radiance, row 0 (+Y) at the top: `FILE`, or `FILE:LAYER` for a layer or part of
/// an EXR. The file is .hdr, .exr or what else OpenImageIO reads in floating point; how it is read, read_raw says. One
/// channel is taken as grey, a fourth is left out. Negative texels become 0; they, a map that is not twice as wide as
/// high, and a layer that nobody named add a line each to `*warnings`. `memory_limit` is read_raw's. Throws an Error where the map cannot be read or a
/// texel is not finite.
Environment load_environment(const std::string& name, std::string* warnings = nullptr, std::uint64_t memory_limit = 0);

/// A constant sky, slightly blue, of luminance 1.
Environment neutral_sky();

}  // namespace diptych::core
