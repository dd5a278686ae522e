// A random scene as files, and back.
#pragma once

#include <filesystem>

#include "random_scene/random_scene.h"

namespace diptych::core {

/// The file of the environment's map beside the scene's file: NAME-sky.exr.
std::filesystem::path random_sky_path(const std::filesystem::path& path);

/// Writes `path` (.gltf or .glb), the files beside it, and the environment's map, if there is one. The lens, the
/// environment and the settings of `random` are not in these files: no glTF file can hold them.
void write_random_scene(const RandomScene& random, const std::filesystem::path& path);

/// The scene as the program reads it from those files. Throws Error where the import has a warning
/// other than that a material reads a UV set that its mesh lacks, which scenes are drawn to do.
Scene read_random_scene(const RandomScene& random, const std::filesystem::path& path);

}  // namespace diptych::core
