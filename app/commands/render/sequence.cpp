#include "commands/render/sequence.h"

#include <fmt/format.h>

#include "commands/command.h"
#include "commands/render/picture.h"
#include "console/interrupt.h"
#include "render/frames.h"
#include "render/seeds.h"
#include "session/open_session.h"
#include "console/report.h"

namespace diptych::core::app {

std::string frame_path(const std::string& output, std::uint32_t frame, std::uint32_t frames) {
    const std::size_t name = output.find_last_of('/') == std::string::npos ? 0 : output.find_last_of('/') + 1;
    const std::size_t last = output.find_last_of('#');
    if (last != std::string::npos && last >= name && frames > 0) {
        std::size_t first = last;
        while (first > name && output[first - 1] == '#') {
            --first;
        }
        return output.substr(0, first) + fmt::format("{:0{}}", frame, last - first + 1) + output.substr(last + 1);
    }
    if (frames <= 1) {
        return output;
    }
    const std::size_t dot = output.find_last_of('.');
    const std::size_t end = dot == std::string::npos || dot <= name ? output.size() : dot;
    return output.substr(0, end) + fmt::format(".{:04}", frame) + output.substr(end);
}

int render_sequence(const Scene& scene, const RenderRequest& request, bool json, LiveView* live) {
    const FrameMoments moments(scene, request);
    Session session = open_played(scene, request);
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    InterruptGuard interrupt;
    bool interrupted = false;
    for (std::uint32_t i = 0; i < request.warm_up + request.frames && !interrupted; ++i) {
        RenderRequest frame = request;
        if (session.chained()) {
            frame.warm_up = i;
        } else {
            frame.start = request.start + i / request.fps;
            frame.settings.seed = neighbor_seed(request.settings.seed, i);
        }
        const bool goes_on = session.chained() && i > 0;
        session.show(moments.at(i), goes_on ? std::nullopt : std::optional(frame.settings.seed));
        if (i < request.warm_up) {
            session.render(0, request.spp, interrupt.requested());
            interrupted = interrupt.requested();
            continue;
        }
        frame.output = frame_path(request.output, i - request.warm_up, request.frames);
        frame.frames = 1;
        frame.frame = i - request.warm_up;
        const std::string label = fmt::format("frame {}/{}  ", frame.frame + 1, request.frames);
        Picture picture =
            render_picture(session, frame, interrupt.requested(), {.label = label, .quiet = json, .live = live});
        if (picture.saved) {
            picture.json["pack_seconds"] = session.pack_seconds();
            picture.json["move_seconds"] = session.move_seconds();
            list.push_back(std::move(picture.json));
        }
        interrupted = picture.interrupted;
    }
    if (json) {
        print_json(list);
    }
    return interrupted ? interrupt_exit_code() : exit_done;
}

}  // namespace diptych::core::app
