// Recorded paths as rows of a table, for whoever lays one out.
#pragma once

#include <string>
#include <vector>

#include "measure/replay.h"

namespace diptych::core {

struct ReplayRow {
    std::string label;               // what belongs to the row above begins with two spaces
    std::vector<std::string> cells;  // one a path
    std::string difference;          // "=" or how far they differ; empty where there is nothing to compare
    bool marked = false;             // where the paths part
};

/// A vertex, or the whole path.
struct ReplayGroup {
    std::string title;
    std::vector<ReplayRow> rows;
};

/// In order along the path, the whole path last. Without `constants` lights are told by their numbers alone.
std::vector<ReplayGroup> replay_groups(const Replay& replay, const shared::RenderConstants* constants, int digits = 6);

/// "triangle 12", "punctual 0", "sky", "none".
std::string light_text(std::uint32_t id, const shared::RenderConstants* constants);
std::string lobe_text(std::uint32_t lobe);
std::string shadow_text(std::uint32_t shadow);

}  // namespace diptych::core
