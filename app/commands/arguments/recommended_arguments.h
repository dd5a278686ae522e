// The options of `diptych render` that show a scene of the project as it is meant: what its glTF file cannot hold.
#pragma once

#include <filesystem>
#include <string>

#include "generate/generate.h"
#include "random_scene/random_scene.h"

namespace diptych::core::app {

std::string recommended_arguments(const RecommendedSettings& settings);

/// For the scene in the file that write_random_scene wrote to `path`.
std::string recommended_arguments(const RandomScene& random, const std::filesystem::path& path);

}  // namespace diptych::core::app
