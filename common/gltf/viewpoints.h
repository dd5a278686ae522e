// Cameras and punctual lights that hang in glTF nodes.
#pragma once

#include "gltf/nodes.h"
#include "scene/scene.h"

namespace diptych::core::gltf {

/// The camera cameras[index] standing in `node`. Throws Error where its values make no view.
Camera import_camera(Document& document, int index, int node, const NodeTree& tree);

/// The light that `node` names by KHR_lights_punctual, or none. Throws Error where that is not there.
int find_light(const Document& document, int node);

/// The light lights[index] standing in `node`. Candela and lux are taken as W/sr and W/m^2. Throws Error where its type
/// is unknown.
PunctualLight import_light(Document& document, int index, int node, const NodeTree& tree);

}  // namespace diptych::core::gltf
