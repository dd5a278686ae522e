// One picture of a render: sampled, saved, reported.
#pragma once

#include <atomic>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "commands/render/kept_work.h"
#include "render/device_loss.h"
#include "render/request.h"
#include "render/session.h"

namespace diptych::core::app {

struct Picture {
    nlohmann::ordered_json json;
    std::string line;  // about the file that was written
    bool saved = false;  // not where an interrupt came before the first sample
    bool interrupted = false;
    bool lost = false;       // the device, before the end
    bool fell_back = false;  // saved, but in the fallback folder
};

int picture_exit_code(const Picture& picture);

class LiveView;

/// Who is told while it renders.
struct PictureAudience {
    std::string label;         // before the progress line
    bool quiet = false;        // the JSON is told at the end, not a line
    LiveView* live = nullptr;  // sees the picture now and then, and at the end
};

/// Renders the session's picture until the request's samples or seconds are reached, `cancel` is set, or the device is
/// lost and `guard` has it stop. Goes on from the samples that earlier runs have left in `files`. Writes request.output,
/// or what is unfinished to a file beside it, and says so. `begin` brings a renewed session of restir before the
/// picture's first sample. Throws Error.
Picture render_picture(Session& session, const RenderRequest& request, const std::atomic<bool>& cancel,
                       const PictureAudience& audience, const WorkFiles& files, LossGuard& guard,
                       const std::function<void()>& begin);

}  // namespace diptych::core::app
