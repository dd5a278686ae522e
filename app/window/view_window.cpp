#include "window/view_window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <thread>

#include "backend/cpu_renderer.h"
#include "command.h"
#include "error.h"
#include "image/image_file.h"
#include "image/tonemap_image.h"
#include "interrupt.h"
#include "validation.h"
#include "view/frame_loop.h"
#include "view/invalidation.h"
#include "vulkan_renderer.h"
#include "window/camera_hand.h"
#include "window/display_choice.h"
#include "window/film_source.h"
#include "window/imgui_context.h"
#include "window/picture_saver.h"
#include "window/presenter.h"
#include "window/view_commands.h"
#include "window/view_log.h"

namespace diptych::app {

namespace {

constexpr double longest_wait = 0.25;  // seconds between frames while nothing happens

double seconds_now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

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

std::string title_of(const std::string& scene) {
    return "diptych – " + std::filesystem::path(scene).filename().string();
}

class ViewWindow {
public:
    ViewWindow(const WindowOptions& options, LoadedScene scene);

    /// Until the window is closed, or an interrupt comes; true where that was it.
    bool run();

private:
    void open_device();
    void begin_loop(LoadedScene scene);
    void read_input(double timeout);
    void take_drops();
    void grant_wishes();
    void move_camera(double seconds);
    void fit_film();
    InterfaceFacts facts() const;
    double await_frame();
    void draw_widgets(double passed);
    void step();
    void draw();
    void save_picture();
    void save_radiance();
    void take_answers();
    void recover();
    void say(const std::string& text);
    void report(const std::string& text);
    Panel main_panel() const;
    ViewState& state() { return loop_->state(); }

    WindowOptions options_;
    RenderRequest request_;
    ViewLog log_;
    Window window_;
    ImguiContext imgui_;
    std::shared_ptr<Gpu> gpu_;
    std::unique_ptr<Presenter> presenter_;
    std::unique_ptr<FilmSource> films_;
    std::atomic<bool> news_ = true;  // a panel has something new
    std::unique_ptr<FrameLoop> loop_;
    CameraHand hand_;
    InterfaceState interface_;
    PixelReplay replay_;
    std::optional<shared::PathQuery> asked_;  // to be replayed
    Legend legend_;
    WindowInput input_;
    FilmSaver saver_;
    double last_frame_ = 0;
    double frame_seconds_ = 0;  // averaged
    int frames_owed_ = 0;       // at once, after input: what opens takes a frame to be laid out and one to be seen
    bool settings_held_ = false;
    bool opened_ = false;
    std::uint64_t generation_ = 1;  // of the scene that the title names
};

ViewWindow::ViewWindow(const WindowOptions& options, LoadedScene scene)
    : options_(options), request_(scene.request), log_(options.log),
      window_(title_of(request_.scene), options.width, options.height), imgui_(window_) {
    input_ = window_.poll(0);
    imgui_.fit(input_, options_.interface_scale);
    open_device();
    begin_loop(std::move(scene));
}

void ViewWindow::open_device() {
    gpu_ = open_gpu(gpu_request(request_));
    presenter_ = std::make_unique<Presenter>(gpu_, window_);
    films_ = std::make_unique<FilmSource>(gpu_);
}

void ViewWindow::begin_loop(LoadedScene scene) {
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

void ViewWindow::say(const std::string& text) {
    show_message(interface_, text, false, seconds_now());
}

void ViewWindow::report(const std::string& text) {
    show_message(interface_, text, true, seconds_now());
    log_.write("error", {{"text", text}});
}

void ViewWindow::read_input(double timeout) {
    input_ = window_.poll(timeout);
    if (imgui_.fit(input_, options_.interface_scale)) {
        presenter_->reload_font();
    }
    // Text fields take keys first, as of the frame before.
    if (!ImGui::GetIO().WantTextInput) {
        for (const KeyPress& press : input_.keys) {
            if (const std::optional<int> camera = camera_of(press)) {
                interface_.wishes.camera = camera;
            } else if (const std::optional<Command> command = command_of(press)) {
                run_command(*command, loop_->has(Panel::cpu) && loop_->has(Panel::vulkan), state(), interface_);
            }
        }
    }
    take_drops();
}

void ViewWindow::take_drops() {
    for (const std::string& file : input_.dropped) {
        log_.write("dropped", {{"file", file}});
        std::string extension = std::filesystem::path(file).extension().string();
        std::transform(extension.begin(), extension.end(), extension.begin(),
                       [](unsigned char c) { return std::tolower(c); });
        if (extension == ".hdr" || extension == ".exr") {
            loop_->open_environment(file);
        } else {
            loop_->open_scene(file);
        }
    }
}

Panel ViewWindow::main_panel() const {
    const ShownPanel shown = loop_->state().shown.panel;
    return loop_->has(Panel::vulkan) && (shown == ShownPanel::vulkan || !loop_->has(Panel::cpu)) ? Panel::vulkan
                                                                                                 : Panel::cpu;
}

void ViewWindow::grant_wishes() {
    const Wishes wishes = std::exchange(interface_.wishes, {});
    if (wishes.camera) {
        if (*wishes.camera < static_cast<int>(loop_->scene().scene->cameras.size())) {
            loop_->show_camera(*wishes.camera);
        } else {
            say(fmt::format("the scene has no camera {}", *wishes.camera + 1));
        }
    }
    if (wishes.reset_camera) {
        loop_->show_camera(state().rendered.request.settings.camera);
    }
    if (wishes.focus) {
        const glm::dvec2 point = input_.cursor / glm::dvec2(std::max(input_.width, 1), std::max(input_.height, 1));
        if (!focus_at(point, *loop_->shot(main_panel()), state())) {
            say("nothing to focus on under the pointer");
        }
    }
    if (wishes.copy_command) {
        const std::string file = std::filesystem::path(loop_->scene().request.scene).stem().string() + ".exr";
        const std::string command = loop_->repeat_command(main_panel(), file);
        window_.set_clipboard(command);
        say("copied: " + command);
        log_.write("copied", {{"command", command}});
    }
    if (wishes.screenshot) {
        save_picture();
    }
    if (wishes.save_exr) {
        save_radiance();
    }
    if (wishes.replay_sample) {
        asked_ = {replay_.query().pixel, *wishes.replay_sample};
    }
    if (wishes.quit) {
        glfwSetWindowShouldClose(window_.handle(), GLFW_TRUE);
    }
}

void ViewWindow::save_picture() {
    const std::filesystem::path path = next_picture(options_.folder, loop_->scene().request.scene, ".png");
    try {
        write_png(path, presenter_->picture());
        say("saved " + path.string());
        log_.write("screenshot", {{"file", path.string()}});
    } catch (const DeviceLost&) {
        throw;
    } catch (const Error& error) {
        report(error.what());
    }
}

void ViewWindow::save_radiance() {
    if (!saver_.waiting()) {
        saver_.await(loop_->worker(main_panel())->film(),
                     next_picture(options_.folder, loop_->scene().request.scene, ".exr"));
    }
}

/// What the panels were asked for and have answered.
void ViewWindow::take_answers() {
    if (replay_.update()) {
        log_.write("replayed", {{"paths", replay_.result().paths.size()},
                                {"parted", replay_.result().parting.has_value()},
                                {"error", replay_.error()}});
    }
    try {
        if (const std::optional<std::filesystem::path> saved = saver_.save()) {
            say("saved " + saved->string());
            log_.write("saved", {{"file", saved->string()}});
        }
    } catch (const Error& error) {
        report(error.what());
    }
}

void ViewWindow::move_camera(double seconds) {
    const ImGuiIO& io = ImGui::GetIO();
    const auto axis = [&](int positive, int negative) {
        return (window_.holds(positive) ? 1.0 : 0.0) - (window_.holds(negative) ? 1.0 : 0.0);
    };
    const bool ctrl = window_.holds(GLFW_KEY_LEFT_CONTROL) || window_.holds(GLFW_KEY_RIGHT_CONTROL);
    HandInput input{
        .window = &input_, .mouse_is_free = !io.WantCaptureMouse, .keys_are_free = !io.WantTextInput && !ctrl};
    input.steps = {axis(GLFW_KEY_D, GLFW_KEY_A), axis(GLFW_KEY_E, GLFW_KEY_Q), axis(GLFW_KEY_W, GLFW_KEY_S)};
    input.fast = window_.holds(GLFW_KEY_LEFT_SHIFT) || window_.holds(GLFW_KEY_RIGHT_SHIFT);
    input.seconds = seconds;
    hand_.update(input, loop_->scene(), state());
    if (const std::optional<Click> click = hand_.click()) {
        const RenderSettings& settings = state().rendered.request.settings;
        const glm::dvec2 point = click->at / glm::dvec2(input_.width, input_.height);
        const glm::uvec2 pixel{std::clamp(point.x * settings.width, 0.0, settings.width - 1.0),
                               std::clamp(point.y * settings.height, 0.0, settings.height - 1.0)};
        interface_.replay = true;
        asked_ = {pixel, 0};
        log_.write("replay", {{"pixel", {pixel.x, pixel.y}}});
    }
}

void ViewWindow::fit_film() {
    ViewState& view = state();
    view.paused = input_.width == 0;
    if (input_.width > 0) {
        RenderSettings& settings = view.rendered.request.settings;
        settings.width = std::max(1, static_cast<int>(std::lround(input_.width * options_.scale)));
        settings.height = std::max(1, static_cast<int>(std::lround(input_.height * options_.scale)));
    }
}

InterfaceFacts ViewWindow::facts() const {
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
    facts.now = seconds_now();
    return facts;
}

void ViewWindow::draw() {
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

/// Another device in place of one that is lost: what was accumulated on it stays as the last look at it.
void ViewWindow::recover() {
    report(gpu_->name + ": the device was lost; going on with another");
    presenter_.reset();
    films_.reset();
    open_device();
    if (loop_->has(Panel::vulkan)) {
        loop_->worker(Panel::vulkan)->recover(vulkan_factory(gpu_));
    }
    log_.write("recovered", {{"device", gpu_->name}});
}

/// Waits until a frame is due: no sooner than the frame rate allows, and not before something happens. Returns the
/// seconds since the last.
double ViewWindow::await_frame() {
    const double due = last_frame_ + 1 / options_.frames_per_second;
    std::this_thread::sleep_for(std::chrono::duration<double>(due - seconds_now()));
    const bool at_rest = !hand_.moving() && !state().animation.playing && !news_ && frames_owed_ == 0;
    read_input(at_rest ? longest_wait : 0);
    news_ = false;
    frames_owed_ = input_.any ? 3 : std::max(frames_owed_ - 1, 0);
    const double now = seconds_now();
    const double passed = now - last_frame_;
    frame_seconds_ += (passed - frame_seconds_) * std::min(1.0, passed / 0.5);
    last_frame_ = now;
    return passed;
}

void ViewWindow::draw_widgets(double passed) {
    imgui_.begin_frame();
    const RenderedState before = state().rendered;
    draw_interface(imgui_.theme(), facts(), state(), interface_, replay_);
    const bool changed = invalidation(before, state().rendered) != Invalidation::nothing;
    settings_held_ = ImGui::IsAnyItemActive() && (settings_held_ || changed);
    move_camera(passed);
    ImGui::Render();
}

void ViewWindow::step() {
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

bool ViewWindow::run() {
    const InterruptGuard interrupt;
    last_frame_ = seconds_now();
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

}  // namespace

int show_window(const WindowOptions& options, LoadedScene scene) {
    return ViewWindow(options, std::move(scene)).run() ? exit_interrupted : exit_done;
}

}  // namespace diptych::app
