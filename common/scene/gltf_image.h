// Decoding of the images that a glTF file holds or points at.
#pragma once

#include <vector>

#include "scene/gltf_document.h"
#include "scene/scene.h"

namespace diptych::gltf {

/// Decodes PNG, JPEG and what else OpenImageIO reads (told by content) to 8-bit RGBA; alpha stays unassociated, nothing
/// is colour-managed. Throws Error (its message without the file's name).
TextureImage decode_image(const EncodedImage& encoded);

/// Decodes `document.images[i]` for each i of `wanted`, in that order, on all cores. Throws Error naming the first that
/// fails.
std::vector<TextureImage> decode_images(const Document& document, const std::vector<int>& wanted);

}  // namespace diptych::gltf
