// Recorded paths as a table for people and as JSON for programs.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "measure/replay.h"
#include "pack/packed_scene.h"

namespace diptych::core::app {

/// A column a backend and one of their differences, vertex by vertex; lines end with a line break.
std::string replay_text(const Replay& replay, const shared::RenderConstants& constants);

nlohmann::ordered_json replay_json(const Replay& replay, const shared::RenderConstants& constants);

}  // namespace diptych::core::app
