#include "measure/replay.h"

#include <fmt/format.h>

namespace diptych::core {

void compare_paths(Replay& replay) {
    if (replay.paths.size() > 1) {
        replay.parting = find_parting(replay.paths[0], replay.paths[1], replay.tolerance);
    }
}

void add_path(Replay& replay, Session& session, const shared::PathQuery& query) {
    const std::size_t camera = static_cast<std::size_t>(session.settings().camera);
    replay.origin = glm::dvec3(session.scene().cameras[camera].camera_to_world[3]);
    replay.backends.push_back(session.renderer().backend());
    replay.devices.push_back(session.renderer().device());
    replay.paths.push_back(session.renderer().record_paths({&query, 1}).front());
}

Replay replay_path(std::vector<Session>& sessions, const shared::PathQuery& query, double tolerance) {
    Replay replay;
    replay.tolerance = tolerance;
    for (Session& session : sessions) {
        add_path(replay, session, query);
    }
    compare_paths(replay);
    return replay;
}

std::string parting_text(const Replay& replay) {
    if (!replay.parting) {
        return fmt::format("No vertex differs by more than {:g}.", replay.tolerance);
    }
    const Parting& parting = *replay.parting;
    if (parting.field == RecordField::radiance) {
        return fmt::format("No vertex differs by more than {:g}, but the radiance does: by {:.2g}.", replay.tolerance,
                           parting.difference);
    }
    if (parting.field == RecordField::length) {
        return fmt::format("They part at vertex {}: only one path goes on.", parting.vertex);
    }
    return fmt::format("They part at vertex {}: {} differs by {:.2g} (tolerance {:g}).", parting.vertex,
                       name_of(parting.field), parting.difference, replay.tolerance);
}

}  // namespace diptych::core
