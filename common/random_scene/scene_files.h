// A random scene as files and a command line, and back.
#pragma once

#include <filesystem>
#include <string>

#include "random_scene/random_scene.h"

namespace diptych::core {

/// Writes `path` (.gltf or .glb), what belongs beside it, and the environment's map as NAME-sky.exr. Returns the options
/// that `diptych render` wants beside the file for the same picture: what no glTF file can hold.
std::string write_random_scene(const RandomScene& random, const std::filesystem::path& path);

/// The scene as the program reads it from those files. Throws Error where the import has a warning
/// other than that a material reads a UV set that its mesh lacks, which scenes are drawn to do.
Scene read_random_scene(const RandomScene& random, const std::filesystem::path& path);

}  // namespace diptych::core
