#include "view/frame_loop.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "console/option_names.h"
#include "console/repeat_command.h"
#include "settings/names.h"
#include "scene/orbit.h"
#include "pose/pose.h"
#include "session/scene_setup.h"
#include "view/invalidation.h"
#include "view/panel_engine.h"
#include "view/view_request.h"

namespace diptych::core::app {

namespace {

constexpr std::array<Panel, 2> both_panels = {Panel::cpu, Panel::vulkan};
// Single changes are answered in full at once; those that follow one another faster than this are a motion, and end so
// long after the last.
constexpr double burst_seconds = 0.2;
// Of a frame, for samples; the rest is for showing them.
constexpr double sampling_share = 0.85;

std::size_t place(Panel panel) {
    return static_cast<std::size_t>(panel);
}

}  // namespace

FrameLoop::FrameLoop(const FrameLoopOptions& options, LoadedScene scene) {
    if (options.cpu) {
        workers_[place(Panel::cpu)] = std::make_unique<PanelWorker>("cpu", options.cpu, 0);
    }
    if (options.vulkan) {
        workers_[place(Panel::vulkan)] = std::make_unique<PanelWorker>("vulkan", options.vulkan, 1);
    }
    state_.shown.panel = options.vulkan ? ShownPanel::vulkan : ShownPanel::cpu;
    state_.rendered.request = scene.request;
    adopt(std::move(scene));
}

bool FrameLoop::shows(Panel panel) const {
    const ShownPanel shown = state_.shown.panel;
    const ShownPanel alone = panel == Panel::cpu ? ShownPanel::cpu : ShownPanel::vulkan;
    return has(panel) && (shown == alone || shown == ShownPanel::split || shown == ShownPanel::difference);
}

std::shared_ptr<const PanelShot> FrameLoop::shot(Panel panel) const {
    return has(panel) ? worker(panel)->shot() : nullptr;
}

void FrameLoop::adopt(LoadedScene scene) {
    scene_ = std::move(scene);
    RenderRequest& request = state_.rendered.request;
    request.scene = scene_.request.scene;
    request.environment = scene_.request.environment;
    request.adds_neutral_sky = scene_.request.adds_neutral_sky;
    request.camera = scene_.request.camera;
    request.viewpoint = scene_.request.viewpoint;
    if (scene_.scene->environment.kind == EnvironmentKind::none) {
        request.environment_scale = 1;
        request.environment_rotation = 0;
    }
    state_.rendered.scene = scene_.generation;
    state_.animation.duration = duration(*scene_.scene);
    state_.animation.playing = state_.animation.playing && state_.animation.duration > 0;
    const int cameras = static_cast<int>(scene_.scene->cameras.size());
    if (!scene_.reloaded || request.settings.camera >= cameras) {
        state_.rendered.time = 0;
        show_camera(scene_.reloaded ? 0 : scene_.request.settings.camera);
        place_seen();
    }
    loader_.watch(scene_);
}

/// The request's own viewpoint and lens, as `render` takes them.
void FrameLoop::place_seen() {
    const RenderRequest& request = state_.rendered.request;
    Camera& camera = state_.rendered.camera;
    const Camera own = camera;
    place_at(request.viewpoint, camera);
    place_lens(request.lens, camera);
    state_.follows_camera = camera.camera_to_world == own.camera_to_world;
    state_.pivot = orbit_pivot(scene_.bounds, camera);
}

void FrameLoop::show_camera(int index) {
    const Scene& scene = *scene_.scene;
    const auto camera = static_cast<std::size_t>(index);
    state_.rendered.request.settings.camera = index;
    state_.rendered.camera = moves(scene) ? camera_at(scene, camera, state_.rendered.time) : scene.cameras.at(camera);
    state_.follows_camera = true;
    state_.pivot = orbit_pivot(scene_.bounds, state_.rendered.camera);
}

void FrameLoop::open_scene(const std::string& path) {
    RenderRequest request = state_.rendered.request;
    request.scene = path;
    request.camera.clear();
    request.viewpoint = {};
    request.lens = {};
    request.settings.camera = 0;
    loader_.open(std::move(request));
}

void FrameLoop::open_environment(const std::string& path) {
    RenderRequest request = scene_.request;
    request.environment = path;
    loader_.open(std::move(request), true);
}

void FrameLoop::play(double seconds) {
    RenderedState& rendered = state_.rendered;
    const double length = state_.animation.duration;
    if (state_.animation.playing && length > 0) {
        const double time = std::fmod(rendered.time + seconds * state_.animation.speed, length);
        rendered.time = time < 0 ? time + length : time;
    }
    const auto index = static_cast<std::size_t>(rendered.request.settings.camera);
    if (state_.follows_camera && scene_.scene->cameras.at(index).node != none) {
        rendered.camera.camera_to_world = camera_at(*scene_.scene, index, rendered.time).camera_to_world;
    }
}

void FrameLoop::step(double now) {
    const double passed = last_step_ > 0 ? std::max(0.0, now - last_step_) : 0;
    last_step_ = now;
    if (std::optional<LoadedScene> loaded = loader_.take_scene()) {
        guarded([&] { adopt(std::move(*loaded)); });
    }
    if (std::optional<std::string> error = loader_.take_error()) {
        errors_.push_back(std::move(*error));
    }
    guarded([&] { play(passed); });
    post(now);
    for (const Panel panel : both_panels) {
        if (!has(panel)) {
            continue;
        }
        const std::shared_ptr<const PanelShot> shot = worker(panel)->shot();
        histories_[place(panel)].add(*shot, now);
        if (shot->error != reported_[place(panel)] && !shot->error.empty()) {
            errors_.push_back(shot->error);
        }
        reported_[place(panel)] = shot->error;
    }
    light_ = shows(Panel::cpu) && shows(Panel::vulkan)
                 ? verification_light(*worker(Panel::cpu)->shot(), *worker(Panel::vulkan)->shot())
                 : VerificationLight{};
}

void FrameLoop::post(double now) {
    const bool changed = !posted_ || invalidation(*posted_, state_.rendered) != Change::nothing;
    const bool held = state_.interacting || state_.animation.playing;
    const bool soon = now - last_single_ < burst_seconds;
    if (changed && posted_ && !held) {
        in_burst_ = soon;
        last_single_ = now;
    }
    in_burst_ = in_burst_ && now - last_single_ < burst_seconds;
    const bool moving = held || in_burst_;
    const Posting next{moving, state_.paused, state_.keeps_hidden, state_.shown.panel, state_.frames_per_second};
    if (!changed && next == posting_) {
        return;
    }
    posted_ = state_.rendered;
    posting_ = next;
    moving_ = moving;
    ++version_;
    for (const Panel panel : both_panels) {
        if (has(panel)) {
            const bool rests = state_.paused || !shows(panel);
            post_to(panel, rests);
        }
    }
}

void FrameLoop::post_to(Panel panel, bool rests) {
    bool& resting = resting_[place(panel)];
    if (rests && resting && !state_.keeps_hidden) {
        return;
    }
    resting = rests;
    ViewJob job;
    job.scene = scene_.scene;
    job.state = *posted_;
    job.version = version_;
    job.moving = moving_;
    job.paused = rests;
    job.frame_seconds = sampling_share / state_.frames_per_second;
    worker(panel)->post(std::move(job));
}

std::vector<std::string> FrameLoop::take_errors() {
    return std::exchange(errors_, {});
}

std::string FrameLoop::repeat_command(Panel panel, const std::string& output) const {
    RenderRequest request = view_request(state_.rendered, *scene_.scene);
    request.output = output;
    request.backend = panel == Panel::cpu ? "cpu" : "vulkan";
    if (panel == Panel::cpu) {
        request.device.clear();
    }
    request.exposure = state_.shown.exposure;
    request.tonemap = tonemap_name(state_.shown.tonemap);
    const std::uint32_t offset = has(panel) ? worker(panel)->seed_offset() : 0;
    request.settings = panel_settings(request.settings, offset, 1);
    const std::shared_ptr<const PanelShot> seen = shot(panel);
    return app::repeat_command(request, seen && seen->divisor == 1 ? std::max(seen->spp, 1U) : 1);
}

template <class Work>
void FrameLoop::guarded(const Work& work) {
    try {
        work();
    } catch (const Error& error) {
        errors_.push_back(with_option_names(error.what()));
    }
}

}  // namespace diptych::core::app
