#include "render_sequence.h"

#include <fmt/format.h>

#include <chrono>
#include <memory>

#include "backend.h"
#include "command.h"
#include "interrupt.h"
#include "pack/packed_scene.h"
#include "render_picture.h"
#include "report.h"
#include "scene/orbit.h"
#include "scene/pose.h"

namespace diptych::app {

namespace {

/// The scene at any time of the request, from the camera of the request.
class Moments {
public:
    Moments(Scene& scene, const RenderRequest& request)
        : scene_(scene), request_(request), at_rest_(camera()),
          pivot_(request.orbit != 0 ? orbit_pivot(scene, at_rest_) : glm::dvec3(0)) {}

    void show(double seconds) {
        pose_scene(scene_, seconds);
        if (request_.orbit != 0) {
            if (camera().node == none) {
                camera() = at_rest_;
            }
            orbit_camera(camera(), pivot_, request_.orbit * request_.fps * seconds);
        }
    }

private:
    Camera& camera() { return scene_.cameras[static_cast<std::size_t>(request_.settings.camera)]; }

    Scene& scene_;
    const RenderRequest& request_;
    Camera at_rest_;
    glm::dvec3 pivot_;
};

double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

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

int render_sequence(Scene scene, const RenderRequest& request, bool json) {
    // At rest first: origin and radius then depend on no frame.
    PackedScene packed = pack_scene(scene, request.settings);
    Moments moments(scene, request);
    const std::unique_ptr<Renderer> renderer = make_renderer(scene, packed, request);
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    InterruptGuard interrupt;
    bool interrupted = false;
    for (std::uint32_t i = 0; i < request.frames && !interrupted; ++i) {
        RenderRequest frame = request;
        frame.output = frame_path(request.output, i, request.frames);
        frame.frames = 1;
        frame.frame = i;
        frame.start = request.start + i / request.fps;
        frame.settings.seed = request.settings.seed + i;
        const double begin = now();
        moments.show(frame.start);
        pack_moment(scene, request.settings, packed);
        const double packed_at = now();
        renderer->move_to(packed);
        renderer->restart(frame.settings.seed);
        const double moved_at = now();
        const std::string label = fmt::format("frame {}/{}  ", i + 1, request.frames);
        Picture picture =
            render_picture(*renderer, frame, packed.features, interrupt.requested(), label, json);
        interrupted = picture.interrupted;
        if (picture.saved) {
            picture.json["pack_seconds"] = packed_at - begin;
            picture.json["move_seconds"] = moved_at - packed_at;
            list.push_back(std::move(picture.json));
        }
    }
    if (json) {
        print_json(list);
    }
    return interrupted ? exit_interrupted : exit_done;
}

}  // namespace diptych::app
