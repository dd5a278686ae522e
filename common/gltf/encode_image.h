// Encoding of the images that are written beside a glTF file or into it.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace diptych::core::gltf {

/// The image as an 8-bit PNG: RGB where all alphas are 255, RGBA otherwise. The file names no colour space, because
/// glTF says what a texture means. The bytes depend on the version of zlib, the pixels do not. Throws Error where the
/// size and the number of texels disagree.
std::vector<std::uint8_t> encode_image(const TextureImage& image);

}  // namespace diptych::core::gltf
