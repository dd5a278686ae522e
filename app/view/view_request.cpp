#include "view/view_request.h"

#include <fmt/format.h>

#include "pose/pose.h"
#include "render/frames.h"

namespace diptych::core::app {

Moment moment_of(const RenderedState& state) {
    Moment moment = requested_lights(state.request);
    moment.seconds = state.time;
    moment.camera = state.camera;
    return moment;
}

RenderRequest view_request(const RenderedState& state, const Scene& loaded) {
    RenderRequest request = state.request;
    const auto index = static_cast<std::size_t>(request.settings.camera);
    const Camera own = moves(loaded) ? camera_at(loaded, index, state.time) : loaded.cameras.at(index);
    const Camera& seen = state.camera;
    request.viewpoint = {};
    if (seen.camera_to_world != own.camera_to_world || seen.vertical_fov != own.vertical_fov ||
        seen.orthographic_height != own.orthographic_height) {
        request.viewpoint = viewpoint_of(seen, seen.lens.focus_distance);
    }
    request.lens = {};
    if (seen.lens != own.lens) {
        request.lens = {seen.lens.radius, seen.lens.focus_distance};
    }
    if (index > 0) {
        request.camera = fmt::format("{}", index);
    }
    request.frames = moves(loaded) ? 1 : 0;
    request.start = moves(loaded) ? state.time : 0;
    request.warm_up = 0;
    request.orbit = 0;
    return request;
}

}  // namespace diptych::core::app
