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

namespace {

/// What render_picture does to the renderer.
void render_unseen(Renderer& renderer, const PictureChain& chain, std::uint32_t spp, const std::atomic<bool>& cancel) {
    renderer.render(chain.first_sample, 1, cancel);
    if (spp > 1) {
        if (chain.after_first) {
            chain.after_first();
        }
        renderer.render(chain.first_sample + 1, spp - 1, cancel);
    }
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

int render_sequence(Scene scene, RenderRequest request, bool json, LiveView* live) {
    const bool chained = request.backend != "oracle" && chains_frames(request.settings);
    request.settings.moves = chained && (moves(scene) || request.orbit != 0);
    // At rest first: origin and radius then depend on no frame.
    PackedScene packed = pack_scene(scene, request.settings);
    Moments moments(scene, request);
    const std::unique_ptr<Renderer> renderer = make_renderer(scene, packed, request);
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    InterruptGuard interrupt;
    bool interrupted = false;
    const auto show = [&](double seconds) {
        moments.show(seconds);
        pack_moment(scene, request.settings, packed);
        const double packed_at = now();
        renderer->move_to(packed);
        return packed_at;
    };
    for (std::uint32_t i = 0; i < request.warm_up + request.frames && !interrupted; ++i) {
        RenderRequest frame = request;
        if (chained) {
            frame.warm_up = i;
        } else {
            frame.start = request.start + i / request.fps;
            frame.settings.seed = request.settings.seed + i;
        }
        const double begin = now();
        const double packed_at = show(shown_at(frame));
        PictureChain chain;
        if (chained && i > 0) {
            renderer->clear_film();
        } else {
            renderer->restart(frame.settings.seed);
        }
        if (chained) {
            chain.first_sample = i * request.spp;
        }
        if (request.settings.moves) {
            // The frame's other samples look back to this same moment.
            chain.after_first = [&] { show(shown_at(frame)); };
        }
        const double moved_at = now();
        if (i < request.warm_up) {
            render_unseen(*renderer, chain, request.spp, interrupt.requested());
            interrupted = interrupt.requested();
            continue;
        }
        frame.output = frame_path(request.output, i - request.warm_up, request.frames);
        frame.frames = 1;
        frame.frame = i - request.warm_up;
        const std::string label = fmt::format("frame {}/{}  ", frame.frame + 1, request.frames);
        Picture picture = render_picture(*renderer, frame, packed.features, interrupt.requested(),
                                         {.label = label, .quiet = json, .live = live}, chain);
        if (picture.saved) {
            picture.json["pack_seconds"] = packed_at - begin;
            picture.json["move_seconds"] = moved_at - packed_at;
            list.push_back(std::move(picture.json));
        }
        interrupted = picture.interrupted;
    }
    if (json) {
        print_json(list);
    }
    return interrupted ? exit_interrupted : exit_done;
}

}  // namespace diptych::app
