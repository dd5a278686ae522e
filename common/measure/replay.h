// One path on several backends from the same random numbers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/recorded_path.h"
#include "render/session.h"

namespace diptych::core {

/// One path on one or two backends.
struct Replay {
    std::vector<std::string> backends;
    std::vector<std::string> devices;
    std::vector<RecordedPath> paths;
    std::optional<Parting> parting;  // of the two, where there are two
    double tolerance = 0;
    glm::dvec3 origin{};  // of the records' coordinates, in the scene's
};

/// Sets where the first two part, by the tolerance.
void compare_paths(Replay& replay);

/// Adds the path that the query names, traced in a session of a scene at rest. Throws Error where its backend keeps no
/// record of its paths.
void add_path(Replay& replay, Session& session, const shared::PathQuery& query);

/// Traces the path that the query names in every session, all of one scene at rest. `tolerance`: differences up to here
/// are rounding. Throws Error where a backend keeps no record of its paths.
Replay replay_path(std::vector<Session>& sessions, const shared::PathQuery& query, double tolerance);

/// "They part at vertex 2: light pdf differs by 0.004." in one line.
std::string parting_text(const Replay& replay);

}  // namespace diptych::core
