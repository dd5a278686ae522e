#include "view/headless.h"

#include <fmt/format.h>

#include <algorithm>
#include <condition_variable>
#include <mutex>

#include "clock.h"
#include "session/make_renderer.h"
#include "console/output.h"
#include "console/exit_codes.h"
#include "error.h"
#include "image/image_file.h"
#include "console/interrupt.h"
#include "settings/names.h"
#include "render/save_film.h"
#include "console/report.h"
#include "view/camera_control.h"
#include "view/frame_loop.h"
#include "view/picture_pass.h"

namespace diptych::core::app {

namespace {

constexpr double turn_a_frame = 0.0175;  // radians, about a degree
constexpr std::uint32_t unmeasured = 8;  // frames in which the panels learn their speed

/// Frames of one kind.
struct FrameTimes {
    std::vector<double> milliseconds;
    std::vector<double> samples;  // a pixel, added in the frame, of the panel that added fewest
    std::vector<double> divisors;
};

double quantile(std::vector<double> values, double share) {
    if (values.empty()) {
        return 0;
    }
    const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1) + 0.5);
    std::nth_element(values.begin(), values.begin() + at, values.end());
    return values[static_cast<std::size_t>(at)];
}

nlohmann::ordered_json to_json(const FrameTimes& times) {
    nlohmann::ordered_json json;
    json["frames"] = times.milliseconds.size();
    json["median_ms"] = quantile(times.milliseconds, 0.5);
    json["p95_ms"] = quantile(times.milliseconds, 0.95);
    json["samples"] = quantile(times.samples, 0.5);
    json["divisor"] = quantile(times.divisors, 0.5);
    return json;
}

std::string line_of(const char* what, const FrameTimes& times) {
    const double median = quantile(times.milliseconds, 0.5);
    return fmt::format("{:<7}{:>7.2f} ms per frame ({:.1f} fps), 95 % below {:.2f} ms; {} sample{} per frame, "
                       "previews at 1/{} of the resolution",
                       what, median, 1000 / std::max(median, 1e-9), quantile(times.milliseconds, 0.95),
                       quantile(times.samples, 0.5), quantile(times.samples, 0.5) == 1 ? "" : "s",
                       quantile(times.divisors, 0.5));
}

class HeadlessView {
public:
    HeadlessView(const HeadlessOptions& options, LoadedScene scene);

    /// One frame, from its change to its picture.
    void frame(bool moving, FrameTimes* times);
    void save();
    nlohmann::ordered_json facts() const;

private:
    void await_shots();
    std::shared_ptr<const PanelShot> seen(Panel panel) const { return seen_[static_cast<std::size_t>(panel)]; }
    Panel main_panel() const { return loop_->shows(Panel::vulkan) ? Panel::vulkan : Panel::cpu; }

    HeadlessOptions options_;
    std::unique_ptr<PicturePass> pass_;
    std::mutex mutex_;
    std::condition_variable news_;
    std::unique_ptr<FrameLoop> loop_;
    std::array<std::shared_ptr<const PanelShot>, 2> seen_;
};

HeadlessView::HeadlessView(const HeadlessOptions& options, LoadedScene scene) : options_(options) {
    FrameLoopOptions panels;
    RenderRequest of_cpu = scene.request;
    of_cpu.backend = "cpu";
    if (options.panel != ShownPanel::vulkan) {
        panels.cpu = [of_cpu](const PackedScene& packed) { return make_renderer(Scene{}, packed, of_cpu); };
    }
    if (options.panel != ShownPanel::cpu) {
        pass_ = std::make_unique<PicturePass>(scene.request);
        panels.vulkan = pass_->factory();
    }
    loop_ = std::make_unique<FrameLoop>(panels, std::move(scene));
    loop_->state().shown.panel = options.panel;
    loop_->state().shown.exposure = loop_->scene().request.exposure;
    loop_->state().shown.tonemap = tonemap_from_name(loop_->scene().request.tonemap);
    loop_->state().frames_per_second = options.frames_per_second;
    for (const Panel panel : {Panel::cpu, Panel::vulkan}) {
        if (loop_->has(panel)) {
            loop_->worker(panel)->on_shot([this] {
                const std::lock_guard lock(mutex_);
                news_.notify_one();
            });
        }
    }
}

/// Of every panel that is shown, one that is new, of the newest version, with a sample.
void HeadlessView::await_shots() {
    for (const Panel panel : {Panel::cpu, Panel::vulkan}) {
        if (!loop_->shows(panel)) {
            continue;
        }
        auto& last = seen_[static_cast<std::size_t>(panel)];
        std::shared_ptr<const PanelShot> shot;
        std::unique_lock lock(mutex_);
        news_.wait(lock, [&] {
            shot = loop_->shot(panel);
            return !shot->error.empty() || (shot != last && shot->version == loop_->version() && shot->spp > 0);
        });
        if (!shot->error.empty()) {
            throw Error(shot->error);
        }
        last = shot;
    }
}

void HeadlessView::frame(bool moving, FrameTimes* times) {
    const std::shared_ptr<const PanelShot> before = seen(main_panel());
    const double begin = now_seconds();
    ViewState& state = loop_->state();
    state.interacting = moving;
    if (moving) {
        orbit(state.rendered.camera, state.pivot, turn_a_frame, 0);
        state.follows_camera = false;
    }
    loop_->step(begin);
    for (const std::string& error : loop_->take_errors()) {
        throw Error(error);
    }
    await_shots();
    const RenderSettings& settings = state.rendered.request.settings;
    if (pass_) {
        const auto shown = [&](Panel panel) { return loop_->shows(panel) ? seen(panel).get() : nullptr; };
        pass_->draw(state.shown, shown(Panel::cpu), shown(Panel::vulkan), settings.width, settings.height);
    }
    if (times != nullptr) {
        const PanelShot& shot = *seen(main_panel());
        const bool same_picture = !moving && before && before->version == shot.version && before->spp < shot.spp;
        times->milliseconds.push_back(1000 * (now_seconds() - begin));
        times->samples.push_back(shot.spp - (same_picture ? before->spp : 0));
        times->divisors.push_back(shot.divisor);
    }
}

void HeadlessView::save() {
    if (options_.output.empty()) {
        return;
    }
    if (pass_ && image_format(options_.output) == ImageFormat::Png) {
        write_png(options_.output, pass_->picture());
        return;
    }
    KeptFilm kept = loop_->worker(main_panel())->film().get();
    kept.request.output = options_.output;
    save_film(kept.film, kept.request, kept.outcome);
}

nlohmann::ordered_json HeadlessView::facts() const {
    const RenderSettings& settings = loop_->scene().request.settings;
    nlohmann::ordered_json json;
    json["scene"] = loop_->scene().request.scene;
    json["width"] = settings.width;
    json["height"] = settings.height;
    json["integrator"] = name_of(settings.integrator);
    json["frames_per_second"] = options_.frames_per_second;
    for (const Panel panel : {Panel::cpu, Panel::vulkan}) {
        if (const auto shot = seen(panel)) {
            nlohmann::ordered_json of_panel;
            of_panel["backend"] = shot->backend;
            of_panel["device"] = shot->device;
            of_panel["samples_per_second"] = shot->samples_per_second;
            of_panel["spp"] = shot->spp;
            of_panel["bytes"] = shot->costs.bytes;
            json["panels"].push_back(of_panel);
        }
    }
    json["light"] = loop_->light().text;
    return json;
}

}  // namespace

int run_headless(const HeadlessOptions& options, LoadedScene scene) {
    HeadlessView view(options, std::move(scene));
    InterruptGuard interrupt;
    const auto run = [&](std::uint32_t frames, bool moving, FrameTimes* times) {
        for (std::uint32_t i = 0; i < frames && !interrupt.requested(); ++i) {
            view.frame(moving, times);
        }
    };
    FrameTimes moving;
    FrameTimes resting;
    run(unmeasured, true, nullptr);
    run(options.frames / 2, true, &moving);
    run(options.frames - options.frames / 2, false, &resting);
    view.save();
    nlohmann::ordered_json json = view.facts();
    json["moving"] = to_json(moving);
    json["resting"] = to_json(resting);
    if (options.json) {
        print_json(json);
    } else {
        for (const nlohmann::ordered_json& panel : json["panels"]) {
            print_result("{}: {}\n", panel["backend"].get<std::string>(), panel["device"].get<std::string>());
        }
        print_result("{}\n{}\n", line_of("moving", moving), line_of("resting", resting));
    }
    return interrupt.requested() ? interrupt_exit_code() : exit_done;
}

}  // namespace diptych::core::app
