// Decoding of the images that a glTF file holds or points at.
#pragma once

#include <vector>

#include "gltf/document.h"
#include "scene/scene.h"

namespace diptych::core::gltf {

/// Decodes PNG, JPEG, WebP and what else OpenImageIO reads (told by content) to 8-bit RGBA; alpha stays unassociated,
/// nothing is colour-managed. Throws Error (its message without the file's name), and OverBudget.
TextureImage decode_image(const EncodedImage& encoded, MemoryBudget& budget);

/// Whether this OpenImageIO reads WebP. Throws Error in the name of `object` where there is none.
bool reads_webp(const Document& document, const std::string& object);

/// Magenta and black squares, which stand for an image that cannot be had.
TextureImage checker(const std::string& name);

/// Images, and for each why it cannot be had; empty where it can.
struct DecodedImages {
    std::vector<TextureImage> images;
    std::vector<std::string> problems;
};

/// Decodes `document.images[i]` for each i of `wanted`, in that order, on all cores. What cannot be had is a checker.
/// Throws OverBudget.
DecodedImages decode_images(const Document& document, const std::vector<int>& wanted);

}  // namespace diptych::core::gltf
