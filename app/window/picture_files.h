// Pictures of a view as files.
#pragma once

#include <filesystem>
#include <string>

#include "image/image.h"
#include "view/panel_worker.h"

namespace diptych::app {

/// FOLDER/SCENE-view-001.EXTENSION: the first number that no file of any kind has.
std::filesystem::path next_picture(const std::filesystem::path& folder, const std::string& scene, const std::string& extension);

/// Radiance and layers, with the metadata that a render of the same samples has. Throws Error.
void save_exr(const std::filesystem::path& path, KeptFilm kept);

}  // namespace diptych::app
