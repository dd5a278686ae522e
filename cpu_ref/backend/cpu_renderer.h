// The CPU panel: the shared kernels over Embree, in parallel over tiles.
#pragma once

#include <memory>

#include "pack/packed_scene.h"
#include "render/renderer.h"

namespace diptych::core {

/// Keeps a reference to the packed scene, which must outlive it. `threads` 0 means all. Images depend on neither
/// threads nor tiles: every pixel sums its own samples, in their order.
std::unique_ptr<Renderer> make_cpu_renderer(const PackedScene& packed, int threads);

/// The processor's own name, or "CPU".
std::string cpu_name();

}  // namespace diptych::core
