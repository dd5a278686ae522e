// The loop of a view's frames.
#include "window/open_view.h"

#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

#include "clock.h"
#include "error.h"
#include "console/interrupt.h"
#include "view/invalidation.h"
#include "window/display_choice.h"

namespace diptych::core::app {

namespace {

constexpr double longest_wait = 0.25;  // seconds between frames while nothing happens

}  // namespace

bool OpenView::run() {
    const InterruptGuard interrupt;
    last_frame_ = now_seconds();
    while (true) {
        const double passed = await_frame();
        if (input_.closed || interrupt.requested()) {
            break;
        }
        take_answers();
        fit_film();
        if (input_.width > 0) {
            draw_widgets(passed);
        }
        step();
        try {
            if (input_.width > 0) {
                draw();
            }
            grant_wishes();
            if (loop_->shot(Panel::vulkan)->device_lost) {
                recover();
            }
        } catch (const DeviceLost&) {
            recover();
        }
        log_.follow(facts(), state(), interface_, last_frame_);
    }
    log_.write("quit");
    return interrupt.requested();
}

/// Waits until a frame is due: no sooner than the frame rate allows, and not before something happens. Returns the
/// seconds since the last.
double OpenView::await_frame() {
    const double due = last_frame_ + 1 / options_.frames_per_second;
    std::this_thread::sleep_for(std::chrono::duration<double>(due - now_seconds()));
    const bool at_rest = !hand_.moving() && !state().animation.playing && !news_ && frames_owed_ == 0;
    read_input(at_rest ? longest_wait : 0);
    news_ = false;
    frames_owed_ = input_.any ? 3 : std::max(frames_owed_ - 1, 0);
    const double now = now_seconds();
    const double passed = now - last_frame_;
    frame_seconds_ += (passed - frame_seconds_) * std::min(1.0, passed / 0.5);
    last_frame_ = now;
    return passed;
}

void OpenView::fit_film() {
    ViewState& view = state();
    view.paused = input_.width == 0;
    if (input_.width > 0) {
        RenderSettings& settings = view.rendered.request.settings;
        settings.width = std::max(1, static_cast<int>(std::lround(input_.width * options_.scale)));
        settings.height = std::max(1, static_cast<int>(std::lround(input_.height * options_.scale)));
    }
}

void OpenView::draw_widgets(double passed) {
    imgui_.begin_frame();
    const RenderedState before = state().rendered;
    draw_interface(imgui_.theme(), facts(), state(), interface_, replay_);
    const bool changed = invalidation(before, state().rendered) != Change::nothing;
    settings_held_ = ImGui::IsAnyItemActive() && (settings_held_ || changed);
    move_camera(passed);
    ImGui::Render();
}

void OpenView::step() {
    state().interacting = hand_.moving() || settings_held_;
    state().keeps_hidden = interface_.replay;
    loop_->step(last_frame_);
    if (loop_->scene().generation != generation_) {
        generation_ = loop_->scene().generation;
        window_.set_title(title_of(loop_->scene().request.scene));
        log_.write("loaded", {{"scene", loop_->scene().request.scene}, {"generation", generation_}});
    }
    if (asked_) {  // once both panels have been told of the picture
        replay_.ask(*loop_, *std::exchange(asked_, {}), state().rendered.request.settings.seed);
    }
    for (const std::string& error : loop_->take_errors()) {
        report(error);
    }
}

void OpenView::draw() {
    const DisplayRequest request =
        choose_display(state().shown, films_->film_of(*loop_, Panel::cpu), films_->film_of(*loop_, Panel::vulkan),
                       static_cast<std::uint32_t>(input_.width), presenter_->range(), legend_);
    presenter_->draw(request, {static_cast<std::uint32_t>(input_.width), static_cast<std::uint32_t>(input_.height)},
                     *ImGui::GetDrawData());
    if (!opened_) {
        opened_ = true;
        log_.write("opened", {{"scene", loop_->scene().request.scene},
                              {"device", gpu_->name},
                              {"width", input_.width},
                              {"height", input_.height}});
    }
}

InterfaceFacts OpenView::facts() const {
    InterfaceFacts facts;
    facts.scene = &loop_->scene();
    const auto tell = [&](Panel panel, const char* title, const ImVec4& color) {
        PanelFacts told{.title = title, .color = color, .shot = loop_->shot(panel)};
        told.history = told.shot != nullptr ? &loop_->history(panel) : nullptr;
        told.shown = loop_->shows(panel);
        return told;
    };
    facts.panels = {tell(Panel::cpu, "CPU", colors::cpu), tell(Panel::vulkan, "Vulkan", colors::vulkan)};
    facts.light = loop_->light();
    facts.legend = legend_;
    facts.frames_per_second = frame_seconds_ > 0 ? 1 / frame_seconds_ : 0;
    facts.loading = loop_->loading();
    facts.now = now_seconds();
    return facts;
}

}  // namespace diptych::core::app
