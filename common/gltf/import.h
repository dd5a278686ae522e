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

/// What a node of a file carries, and where Scene::nodes has it.
struct NodeUse {
    int instance = none;  // of the scene, which hangs in the node; none too where a skin's joints place the mesh
    int camera = none;
    int light = none;
    int scene_node = none;  // index into Scene::nodes
    bool moves = false;     // the node or an ancestor is animated, so what it carries names the scene's node
};

/// All nodes of a file at rest, with the file's indices, parents' too: a parent may stand after its children. A scene
/// keeps only those that move or carry what moves.
struct FileNodes {
    std::vector<Node> nodes;
    std::vector<NodeUse> uses;  // as many
};

/// Loads a .gltf or .glb file: the default scene (else the first, else all root nodes) at rest, skins and morph targets
/// baked, with its animations (pose.h). Faults that a picture can be made in spite of become Scene::warnings, and
/// those of keyframes Animation::warnings. Throws Error, one line naming file, object and reason, where the file cannot
/// be read, its data cannot be used, or it requires an extension that is neither supported nor ignored by `options`.
/// The environment stays empty. `nodes` gets the file's nodes, for a caller that edits them.
Scene load_gltf(const std::filesystem::path& path, const GltfOptions& options = {}, FileNodes* nodes = nullptr);

}  // namespace diptych::core
