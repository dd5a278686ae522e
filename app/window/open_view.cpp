// What a view owns: set up, and made anew where the device is lost.
#include "window/open_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "backend/cpu_renderer.h"
#include "clock.h"
#include "console/option_names.h"
#include "image/tonemap_image.h"
#include "device/validation.h"
#include "renderer/vulkan_renderer.h"

namespace diptych::core::app {

namespace {

GpuRequest gpu_request(const RenderRequest& request) {
    return {.device = request.device,
            .validation = validation_wanted(request.validation),
            .instance_extensions = surface_extensions(),
            .presents = true};
}

RendererFactory vulkan_factory(std::shared_ptr<Gpu> gpu) {
    return [gpu = std::move(gpu)](const PackedScene& packed) { return make_vulkan_renderer(gpu, packed); };
}

RendererFactory cpu_factory(int threads) {
    return [threads](const PackedScene& packed) { return make_cpu_renderer(packed, threads); };
}

}  // namespace

std::string OpenView::title_of(const std::string& scene) {
    return "diptych – " + std::filesystem::path(scene).filename().string();
}

OpenView::OpenView(const WindowOptions& options, LoadedScene scene)
    : options_(options), request_(scene.request), log_(options.log),
      window_(title_of(request_.scene), options.width, options.height), imgui_(window_) {
    input_ = window_.poll(0);
    imgui_.fit(input_, options_.interface_scale);
    open_device();
    begin_loop(std::move(scene));
}

void OpenView::open_device() {
    gpu_ = open_gpu(gpu_request(request_));
    presenter_ = std::make_unique<Presenter>(gpu_, window_);
    films_ = std::make_unique<FilmSource>(gpu_);
}

void OpenView::begin_loop(LoadedScene scene) {
    const FrameLoopOptions options{cpu_factory(request_.threads), vulkan_factory(gpu_)};
    scene.request.settings.width = std::max(1, static_cast<int>(std::lround(input_.width * options_.scale)));
    scene.request.settings.height = std::max(1, static_cast<int>(std::lround(input_.height * options_.scale)));
    loop_ = std::make_unique<FrameLoop>(options, std::move(scene));
    for (const Panel panel : {Panel::cpu, Panel::vulkan}) {
        if (loop_->has(panel)) {
            loop_->worker(panel)->on_shot([this] {
                news_ = true;
                wake_window();
            });
        }
    }
    ViewState& view = state();
    view.frames_per_second = options_.frames_per_second;
    view.shown.panel = options_.panel;
    view.shown.exposure = request_.exposure;
    view.shown.tonemap = tonemap_from_name(request_.tonemap);
}

/// Another device in place of one that is lost: what was accumulated on it stays as the last look at it.
void OpenView::recover() {
    report(gpu_->name + ": the device was lost; going on with another");
    presenter_.reset();
    films_.reset();
    open_device();
    if (loop_->has(Panel::vulkan)) {
        loop_->worker(Panel::vulkan)->recover(vulkan_factory(gpu_));
    }
    log_.write("recovered", {{"device", gpu_->name}});
}

void OpenView::say(const std::string& text) {
    show_message(interface_, text, false, now_seconds());
}

void OpenView::report(const std::string& text) {
    const std::string message = with_option_names(text);
    show_message(interface_, message, true, now_seconds());
    log_.write("error", {{"text", message}});
}

Panel OpenView::main_panel() const {
    const ShownPanel shown = loop_->state().shown.panel;
    return loop_->has(Panel::vulkan) && (shown == ShownPanel::vulkan || !loop_->has(Panel::cpu)) ? Panel::vulkan
                                                                                                 : Panel::cpu;
}

}  // namespace diptych::core::app
