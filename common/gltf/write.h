// Writing the logical scene as glTF 2.0.
#pragma once

#include "scene/scene.h"

#include <filesystem>

namespace diptych::core {

/// Writes the scene as `path`: `.gltf` with a `.bin` and PNG images beside it, or one `.glb`. The bytes depend on the
/// scene alone, except those of PNG images, which depend on the version of zlib too. Instances share meshes; emission,
/// ior, specular, unlit, punctual lights and texture transforms go into their KHR extensions; animations, with the nodes
/// that they move, as they are. What glTF cannot say: a lens (left out) and an environment (a constant one is noted in
/// the scene's `extras.diptych.environment`). The files appear whole and together, or not at all. Throws Error on an
/// extension unknown, a mesh without triangles, an unwritable file.
void write_gltf(const Scene& scene, const std::filesystem::path& path);

}  // namespace diptych::core
