// The emitters alone, as what sampling the material for light points is traced against (trace_emitters of hooks.md): a
// few triangles in place of the whole scene.
#pragma once

#include <vector>

#include "pack/packed_scene.h"

namespace diptych::core {

/// Whether the settings sample materials for light points, and there are emitters to be found.
bool searches_emitters(const PackedScene& packed);

/// Corners of the emissive triangles in world space, three each, by light id. Those of an emitter that sampling the
/// material does not find lie in one point, so that no ray meets them: where it emits nothing, does not show, or
/// lets rays pass by its alpha. They are not NaN, by which Vulkan leaves a triangle out: beside such a triangle lavapipe
/// loses others of the structure.
std::vector<shared::vec3> emitter_corners(const PackedScene& packed);

}  // namespace diptych::core
