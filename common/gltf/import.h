// glTF 2.0 files to logical scenes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace diptych::core {

struct GltfOptions {
    std::vector<std::string>
        ignored_extensions;  // loaded without, though the file requires them and they are not supported
    bool strict = false;          // whatever would be a warning is an error
    bool allow_external = false;  // read buffers and images that lie outside the file's folder too
    std::uint64_t memory_limit = 0;  // bytes that the file may ask for (memory_budget.h); 0: a quarter of the memory
};

/// Loads a .gltf or .glb file: the default scene (else the first, else all root nodes) at rest, skins and morph targets
/// baked, with its animations (pose.h). Faults that a picture can be made in spite of become Scene::warnings, and
/// those of keyframes Animation::warnings. Throws Error, one line naming file, object and reason, where the file cannot
/// be read, its data cannot be used, or it requires an extension that is neither supported nor ignored by `options`.
/// The environment stays empty.
Scene load_gltf(const std::filesystem::path& path, const GltfOptions& options = {});

}  // namespace diptych::core
