// One picture of a render: sampled, saved, reported.
#pragma once

#include <atomic>
#include <nlohmann/json.hpp>
#include <string>

#include "commands/render/kept_work.h"
#include "render/metadata.h"
#include "render/request.h"
#include "render/save_film.h"
#include "render/session.h"

namespace diptych::core::app {

struct Picture {
    nlohmann::ordered_json json;
    bool saved = false;  // not where an interrupt came before the first sample
    bool interrupted = false;
};

class LiveView;

/// Who is told while it renders.
struct PictureAudience {
    std::string label;         // before the progress line
    bool quiet = false;        // no line on stdout at the end
    LiveView* live = nullptr;  // sees the picture now and then, and at the end
    const WorkFiles* files = nullptr;  // to go on from, and to leave; null: unfinished work goes to the output
};

/// Renders the session's picture until the request's samples or seconds are reached or `cancel` is set, from the samples
/// that earlier runs have left. Writes request.output, or what is unfinished to a file beside it, and says so.
/// Throws Error.
Picture render_picture(Session& session, const RenderRequest& request, const std::atomic<bool>& cancel,
                       const PictureAudience& audience);

}  // namespace diptych::core::app
