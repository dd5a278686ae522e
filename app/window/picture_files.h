// Pictures of a view as files.
#pragma once

#include <filesystem>
#include <string>

namespace diptych::app {

/// FOLDER/SCENE-view-001.EXTENSION: the first number that no file of any kind has.
std::filesystem::path next_picture(const std::filesystem::path& folder, const std::string& scene, const std::string& extension);

}  // namespace diptych::app
