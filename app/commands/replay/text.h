// Recorded paths as a table for people and as JSON for programs.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "pack/packed_scene.h"
#include "render/recorded_path.h"

namespace diptych::app {

/// One path on one or two backends.
struct Replay {
    std::vector<std::string> backends;
    std::vector<std::string> devices;
    std::vector<RecordedPath> paths;
    std::optional<Parting> parting;  // of the two, where there are two
    double tolerance = 0;
    glm::dvec3 origin{};  // of the records' coordinates, in the scene's
};

/// A column a backend and one of their differences, vertex by vertex; lines end with a line break.
std::string replay_text(const Replay& replay, const shared::RenderConstants& constants);

nlohmann::ordered_json replay_json(const Replay& replay, const shared::RenderConstants& constants);

/// "They part at vertex 2: light pdf differs by 0.004." in one line.
std::string parting_text(const Replay& replay);

}  // namespace diptych::app
