// Light from infinity: environment maps from files, and the sky for scenes that have no light.
#pragma once

#include <filesystem>
#include <string>

#include "scene/scene.h"

namespace diptych {

/// Reads an equirectangular map (.hdr, .exr or what else OpenImageIO reads in floating point) as linear radiance, row 0
/// (+Y) at the top. One channel is taken as grey, a fourth is left out. Texels that are negative or not finite become 0
/// and are counted in `*warnings`, one line for each oddity, which also names a map that is not twice as wide as high.
/// Throws Error where it cannot be read.
Environment load_environment(const std::filesystem::path& path, std::string* warnings = nullptr);

/// A constant sky, slightly blue, of luminance 1.
Environment neutral_sky();

}  // namespace diptych
