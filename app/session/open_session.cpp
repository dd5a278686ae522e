#include "session/open_session.h"

#include <mutex>
#include <set>

#include "console/report.h"
#include "pose/pose.h"
#include "session/make_renderer.h"

namespace diptych::core::app {

namespace {

void report_once(const std::vector<std::string>& lines) {
    static std::mutex mutex;
    static std::set<std::string> reported;
    const std::lock_guard lock(mutex);
    for (const std::string& line : lines) {
        if (reported.insert(line).second) {
            report_warning(line);
        }
    }
}

}  // namespace

SessionHooks reporting_hooks() {
    return {.busy = {}, .warn = report_once};
}

Session open_session(const Scene& scene, const RenderRequest& request, const MakeRenderer& instead,
                     const BusyHook& busy) {
    return {scene, request.settings, instead ? instead : renderer_maker_of(request, busy),
            {.busy = busy, .warn = report_once}};
}

Session open_session(const Scene& scene, const RenderRequest& request, const Moment& moment,
                     const MakeRenderer& instead, const BusyHook& busy) {
    return {scene,  request.settings, instead ? instead : renderer_maker_of(request, busy),
            moment, {.busy = busy, .warn = report_once}};
}

Session open_played(const Scene& scene, RenderRequest request, const MakeRenderer& instead, const BusyHook& busy) {
    request.settings.moves = request.backend != "oracle" && chains_frames(request.settings) &&
                             (moves(scene) || request.orbit != 0);
    return open_session(scene, request, Moment(), instead, busy);
}

Session open_requested(const Scene& scene, const RenderRequest& request, bool plays) {
    return plays ? open_played(scene, request) : open_session(scene, request);
}

}  // namespace diptych::core::app
