#include "session/played_scene.h"

#include <chrono>

#include "session/backend.h"
#include "session/pack_requested.h"
#include "scene/orbit.h"
#include "pose/pose.h"

namespace diptych::app {

namespace {

double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

PlayedScene::PlayedScene(const Scene& scene, const RenderRequest& request)
    : request_(request), chained_(request.frames > 0 && request.backend != "oracle" && chains_frames(request.settings)),
      posed_(request.frames > 0 ? std::make_unique<Scene>(scene) : nullptr) {
    if (posed_) {
        camera_at_rest_ = camera();
        if (request_.orbit != 0) {
            pivot_ = orbit_pivot(scene, camera_at_rest_);
        }
    }
    request_.settings.moves = chained_ && (moves(scene) || request_.orbit != 0);
    // At rest first: origin and radius then depend on no frame.
    packed_ = pack_requested(scene, request_.settings);
    renderer_ = make_renderer(posed_ ? *posed_ : scene, packed_, request_);
}

BegunFrame PlayedScene::begin_frame(std::uint32_t frame, std::uint32_t seed) {
    const double seconds = request_.start + frame / request_.fps;
    const auto show = [this, seconds] {
        pose(seconds);
        pack_moment(*posed_, request_.settings, packed_);
        const double packed_at = now();
        renderer_->move_to(packed_);
        return packed_at;
    };
    BegunFrame begun;
    const double begin = now();
    const double packed_at = show();
    if (chained_ && frame > 0) {
        renderer_->clear_film();
    } else {
        renderer_->restart(seed);
    }
    if (chained_) {
        begun.chain.first_sample = frame * request_.spp;
    }
    if (request_.settings.moves) {
        // The frame's other samples look back to this same moment.
        begun.chain.after_first = [show] { show(); };
    }
    begun.pack_seconds = packed_at - begin;
    begun.move_seconds = now() - packed_at;
    return begun;
}

void PlayedScene::render_frame(const BegunFrame& frame, const std::atomic<bool>& cancel) {
    const PictureChain& chain = frame.chain;
    if (!chain.after_first) {
        renderer_->render(chain.first_sample, request_.spp, cancel);
        return;
    }
    renderer_->render(chain.first_sample, 1, cancel);
    if (request_.spp > 1) {
        chain.after_first();
        renderer_->render(chain.first_sample + 1, request_.spp - 1, cancel);
    }
}

Camera& PlayedScene::camera() {
    return posed_->cameras[static_cast<std::size_t>(request_.settings.camera)];
}

void PlayedScene::pose(double seconds) {
    pose_scene(*posed_, seconds);
    if (request_.orbit != 0) {
        if (camera().node == none) {
            camera() = camera_at_rest_;
        }
        orbit_camera(camera(), pivot_, request_.orbit * request_.fps * seconds);
    }
}

}  // namespace diptych::app
