// The files that a glTF scene is made of.
#pragma once

#include <filesystem>
#include <vector>

namespace diptych::core {

/// The file itself, then the buffers and images that it refers to, in its order, each once; whether they exist is not
/// asked. Of what cannot be read or parsed, the file alone.
std::vector<std::filesystem::path> gltf_files(const std::filesystem::path& path);

}  // namespace diptych::core
