// PNG files in memory, the same bytes on every machine, so that generated scenes can be compared with committed ones.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <vector>

namespace diptych {

/// The image as an 8-bit PNG (W3C PNG, third edition): RGB where all alphas are 255, RGBA otherwise. No colour chunk is
/// written: glTF says what a texture means. Throws Error where the size and the number of texels disagree.
std::vector<std::uint8_t> encode_png(const TextureImage& image);

}  // namespace diptych
