// Materials, textures and samplers of a glTF file.
#pragma once

#include "gltf/document.h"
#include "scene/scene.h"

namespace diptych::core::gltf {

/// Fills the scene's materials (one for each of the file's, in its order), and the textures and images that they use.
/// Values outside the specification's ranges are clamped with a warning. Throws Error where an index points nowhere or
/// an image that is used cannot be decoded.
void import_materials(Document& document, Scene& scene);

/// The factor and the strength of a material's emission, clamped likewise; `object` names it in warnings.
MovingEmission read_emission(Document& document, const tinygltf::Material& source, const std::string& object);

}  // namespace diptych::core::gltf
