// Paths traced over Embree for what they did, not for a film.
#pragma once

#include <span>
#include <vector>

#include "embree/embree_scene.h"
#include "pack/packed_scene.h"
#include "render/recorded_path.h"

namespace diptych::core {

/// Run within the arena that is to do the work. `constants` stand in for the pack's own.
std::vector<RecordedPath> record_paths(const PackedScene& packed, const shared::RenderConstants& constants,
                                       const EmbreeScene& scene, std::span<const shared::PathQuery> queries);
std::vector<shared::PathSummary> summarize_paths(const PackedScene& packed, const shared::RenderConstants& constants,
                                                 const EmbreeScene& scene, std::span<const shared::PathQuery> queries);

}  // namespace diptych::core
