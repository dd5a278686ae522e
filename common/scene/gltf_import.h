// glTF 2.0 files to logical scenes.
#pragma once

#include <filesystem>

#include "scene/scene.h"

namespace diptych {

/// Loads a .gltf or .glb file: the default scene (else the first, else all root nodes) at rest, skins and morph targets
/// baked. What is merely odd becomes a line of Scene::warnings. Throws Error, one line naming file, object and reason,
/// where the file cannot be read, its data cannot be used, or it requires an extension that is not supported. The
/// environment stays empty.
Scene load_gltf(const std::filesystem::path& path);

}  // namespace diptych
