// From a scene to what is rendered, with a word on what that leaves out.
#pragma once

#include "pack/packed_scene.h"

namespace diptych::app {

/// pack_scene, its warnings on stderr: each once, however often and in however many threads a scene is packed.
PackedScene pack_requested(const Scene& scene, const RenderSettings& settings);

}  // namespace diptych::app
