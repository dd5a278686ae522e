#include "window/view_window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <thread>

#include "backend/cpu_renderer.h"
#include "command.h"
#include "error.h"
#include "interrupt.h"
#include "image/image_file.h"
#include "render_picture.h"
#include "validation.h"
#include "view/frame_loop.h"
#include "view/invalidation.h"
#include "vulkan_renderer.h"
#include "window/camera_hand.h"
#include "window/display_choice.h"
#include "window/picture_files.h"
#include "window/presenter.h"
#include "window/shortcuts.h"
#include "window/view_log.h"

namespace diptych::app {

namespace {

constexpr double longest_wait = 0.25;  // seconds between frames while nothing happens

double seconds_now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Dear ImGui on a window, while it lives.
class ImguiContext {
public:
    explicit ImguiContext(const Window& window) {
        ImGui::CreateContext();
        ImGui::GetIO().IniFilename = nullptr;
        ImGui_ImplGlfw_InitForVulkan(window.handle(), true);
    }
    ~ImguiContext() {
        ImGui_ImplGlfw_Shutdown();
        ImGui::DestroyContext();
    }
    ImguiContext(const ImguiContext&) = delete;
    ImguiContext& operator=(const ImguiContext&) = delete;
};

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

class ViewWindow {
public:
    ViewWindow(const WindowOptions& options, LoadedScene scene);

    /// Until the window is closed, or an interrupt comes; true where that was it.
    bool run();

private:
    void begin_loop(LoadedScene scene);
    void read_input(double timeout);
    void rescale();
    void run_command(Command command);
    void take_drops();
    void grant_wishes();
    void move_camera(double seconds);
    void fit_film();
    InterfaceFacts facts() const;
    void draw();
    void save_picture();
    void save_radiance();
    void take_saved();
    void recover();
    void say(const std::string& text);
    void report(const std::string& text);
    DeviceFilm film_of(Panel panel);
    Panel main_panel() const;
    ViewState& state() { return loop_->state(); }

    WindowOptions options_;
    RenderRequest request_;
    ViewLog log_;
    Window window_;
    ImguiContext imgui_;
    Theme theme_;
    std::shared_ptr<Gpu> gpu_;
    std::unique_ptr<Presenter> presenter_;
    std::unique_ptr<FilmUploader> uploader_;
    std::unique_ptr<FrameLoop> loop_;
    std::shared_ptr<const Film> uploaded_;  // that the uploader's film shows
    DeviceFilm uploaded_device_;
    CameraHand hand_;
    InterfaceState interface_;
    PixelReplay replay_;
    std::optional<shared::PathQuery> asked_;  // to be replayed
    Legend legend_;
    WindowInput input_;
    std::atomic<bool> news_ = true;  // a panel has something new
    std::future<KeptFilm> kept_;
    std::filesystem::path kept_path_;
    double last_frame_ = 0;
    double frame_seconds_ = 0;  // averaged
    bool settings_held_ = false;
    bool opened_ = false;
    float interface_scale_ = 0;
    float pixel_ratio_ = 1;
};

ViewWindow::ViewWindow(const WindowOptions& options, LoadedScene scene)
    : options_(options), request_(scene.request), log_(options.log),
      window_("diptych – " + std::filesystem::path(request_.scene).filename().string(), options.width, options.height), imgui_(window_) {
    input_ = window_.poll(0);
    rescale();
    gpu_ = open_gpu(gpu_request(request_));
    presenter_ = std::make_unique<Presenter>(gpu_, window_);
    uploader_ = std::make_unique<FilmUploader>(gpu_);
    begin_loop(std::move(scene));
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
    if (request_.tonemap != "none") {
        view.shown.tonemap = tonemap_from_name(request_.tonemap);
    }
}

void ViewWindow::say(const std::string& text) {
    show_message(interface_, text, false, seconds_now());
}

void ViewWindow::report(const std::string& text) {
    show_message(interface_, text, true, seconds_now());
    log_.write("error", {{"text", text}});
}

void ViewWindow::rescale() {
    int width = 0;
    int height = 0;
    glfwGetWindowSize(window_.handle(), &width, &height);
    const float ratio = width > 0 && input_.width > 0 ? static_cast<float>(input_.width) / static_cast<float>(width) : pixel_ratio_;
    const float scale = options_.interface_scale > 0 ? options_.interface_scale : input_.content_scale;
    if (scale == interface_scale_ && ratio == pixel_ratio_) {
        return;
    }
    interface_scale_ = scale;
    pixel_ratio_ = ratio;
    theme_ = apply_theme(scale / ratio, ratio);
    if (presenter_ != nullptr) {
        presenter_->reload_font();
    }
}

void ViewWindow::read_input(double timeout) {
    input_ = window_.poll(timeout);
    if (input_.width > 0) {
        rescale();
    }
    // Text fields take keys first, as of the frame before.
    if (!ImGui::GetIO().WantTextInput) {
        for (const KeyPress& press : input_.keys) {
            if (const std::optional<int> camera = camera_of(press)) {
                interface_.wishes.camera = camera;
            } else if (const std::optional<Command> command = command_of(press)) {
                run_command(*command);
            }
        }
    }
    take_drops();
}

template <typename Enum>
void step_through(Enum& value, int steps, int count) {
    value = static_cast<Enum>((static_cast<int>(value) + steps + count) % count);
}

void ViewWindow::run_command(Command command) {
    ViewState& view = state();
    constexpr int layers = 10;
    switch (command) {
        case Command::hide_interface: interface_.visible = !interface_.visible; break;
        case Command::help: interface_.help = !interface_.help; break;
        case Command::next_panel:
            if (loop_->has(Panel::cpu) && loop_->has(Panel::vulkan)) {
                step_through(view.shown.panel, 1, 4);
            }
            break;
        case Command::next_layer: step_through(view.shown.layer, 1, layers); break;
        case Command::previous_layer: step_through(view.shown.layer, -1, layers); break;
        case Command::next_integrator: step_through(view.rendered.request.settings.integrator, 1, 5); break;
        case Command::previous_integrator: step_through(view.rendered.request.settings.integrator, -1, 5); break;
        case Command::next_tonemap: step_through(view.shown.tonemap, 1, 5); break;
        case Command::brighter: view.shown.exposure += 0.25; break;
        case Command::darker: view.shown.exposure -= 0.25; break;
        case Command::focus: {
            const glm::dvec2 point = input_.cursor / glm::dvec2(std::max(input_.width, 1), std::max(input_.height, 1));
            if (!focus_at(point, *loop_->shot(main_panel()), view)) {
                say("nothing to focus on under the pointer");
            }
            break;
        }
        case Command::reset_camera: interface_.wishes.reset_camera = true; break;
        case Command::play: view.animation.playing = !view.animation.playing && view.animation.duration > 0; break;
        case Command::screenshot: interface_.wishes.screenshot = true; break;
        case Command::save_exr: interface_.wishes.save_exr = true; break;
        case Command::copy_command: interface_.wishes.copy_command = true; break;
        case Command::close:
            interface_.messages.clear();
            interface_.help = interface_.replay = false;
            break;
        case Command::quit: interface_.wishes.quit = true; break;
    }
}

void ViewWindow::take_drops() {
    for (const std::string& file : input_.dropped) {
        log_.write("dropped", {{"file", file}});
        std::string extension = std::filesystem::path(file).extension().string();
        std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return std::tolower(c); });
        if (extension == ".hdr" || extension == ".exr") {
            loop_->open_environment(file);
        } else {
            loop_->open_scene(file);
        }
    }
}

Panel ViewWindow::main_panel() const {
    const ShownPanel shown = loop_->state().shown.panel;
    return loop_->has(Panel::vulkan) && (shown == ShownPanel::vulkan || !loop_->has(Panel::cpu)) ? Panel::vulkan : Panel::cpu;
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
    if (wishes.copy_command) {
        const std::string file = std::filesystem::path(request_.scene).stem().string() + ".exr";
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
    if (!kept_.valid()) {
        kept_path_ = next_picture(options_.folder, loop_->scene().request.scene, ".exr");
        kept_ = loop_->worker(main_panel())->film();
    }
}

void ViewWindow::take_saved() {
    if (!kept_.valid() || kept_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
        return;
    }
    try {
        KeptFilm kept = kept_.get();
        kept.request.output = kept_path_.string();
        save_film(kept.film, kept.request, kept.outcome);
        say("saved " + kept_path_.string());
        log_.write("saved", {{"file", kept_path_.string()}});
    } catch (const Error& error) {
        report(error.what());
    }
}

void ViewWindow::move_camera(double seconds) {
    const ImGuiIO& io = ImGui::GetIO();
    const auto axis = [&](int positive, int negative) { return (window_.holds(positive) ? 1.0 : 0.0) - (window_.holds(negative) ? 1.0 : 0.0); };
    const bool ctrl = window_.holds(GLFW_KEY_LEFT_CONTROL) || window_.holds(GLFW_KEY_RIGHT_CONTROL);
    HandInput input{.window = &input_, .mouse_is_free = !io.WantCaptureMouse, .keys_are_free = !io.WantTextInput && !ctrl};
    input.steps = {axis(GLFW_KEY_D, GLFW_KEY_A), axis(GLFW_KEY_E, GLFW_KEY_Q), axis(GLFW_KEY_W, GLFW_KEY_S)};
    input.fast = window_.holds(GLFW_KEY_LEFT_SHIFT) || window_.holds(GLFW_KEY_RIGHT_SHIFT);
    input.seconds = seconds;
    hand_.update(input, loop_->scene(), state());
    if (const std::optional<Click> click = hand_.click()) {
        const RenderSettings& settings = state().rendered.request.settings;
        const glm::dvec2 point = click->at / glm::dvec2(input_.width, input_.height);
        const glm::uvec2 pixel{std::clamp(point.x * settings.width, 0.0, settings.width - 1.0), std::clamp(point.y * settings.height, 0.0, settings.height - 1.0)};
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

DeviceFilm ViewWindow::film_of(Panel panel) {
    const std::shared_ptr<const PanelShot> shot = loop_->shot(panel);
    if (shot == nullptr || !loop_->shows(panel)) {
        return {};
    }
    if (shot->device_film != nullptr) {
        return *shot->device_film;
    }
    if (shot->film == nullptr) {
        return {};
    }
    if (uploaded_ != shot->film) {
        uploaded_device_ = uploader_->upload(*shot->film);
        uploaded_ = shot->film;
    }
    return uploaded_device_;
}

void ViewWindow::draw() {
    const DisplayRequest request =
        choose_display(state().shown, film_of(Panel::cpu), film_of(Panel::vulkan), static_cast<std::uint32_t>(input_.width),
                       presenter_->range(), legend_);
    presenter_->draw(request, {static_cast<std::uint32_t>(input_.width), static_cast<std::uint32_t>(input_.height)}, *ImGui::GetDrawData());
    if (!opened_) {
        opened_ = true;
        log_.write("opened", {{"scene", loop_->scene().request.scene}, {"device", gpu_->name}, {"width", input_.width}, {"height", input_.height}});
    }
}

/// Another device in place of one that is lost: what was accumulated on it stays as the last look at it.
void ViewWindow::recover() {
    report(gpu_->name + ": the device was lost; going on with another");
    presenter_.reset();
    uploader_.reset();
    uploaded_.reset();
    uploaded_device_ = {};
    gpu_ = open_gpu(gpu_request(request_));
    presenter_ = std::make_unique<Presenter>(gpu_, window_);
    uploader_ = std::make_unique<FilmUploader>(gpu_);
    if (loop_->has(Panel::vulkan)) {
        loop_->worker(Panel::vulkan)->recover(vulkan_factory(gpu_));
    }
    log_.write("recovered", {{"device", gpu_->name}});
}

bool ViewWindow::run() {
    const InterruptGuard interrupt;
    last_frame_ = seconds_now();
    while (true) {
        // A frame is due no sooner than the frame rate allows, and not before something happens.
        const double due = last_frame_ + 1 / options_.frames_per_second;
        std::this_thread::sleep_for(std::chrono::duration<double>(due - seconds_now()));
        const bool at_rest = !hand_.moving() && !state().animation.playing && !news_;
        read_input(at_rest ? longest_wait : 0);
        news_ = false;
        const double now = seconds_now();
        const double passed = now - last_frame_;
        frame_seconds_ += (passed - frame_seconds_) * std::min(1.0, passed / 0.5);
        last_frame_ = now;
        if (input_.closed || interrupt.requested()) {
            break;
        }
        if (replay_.update()) {
            log_.write("replayed", {{"paths", replay_.result().paths.size()}, {"parted", replay_.result().parting.has_value()}, {"error", replay_.error()}});
        }
        take_saved();
        fit_film();
        if (input_.width > 0) {
            ImGui_ImplGlfw_NewFrame();
            ImGui::NewFrame();
            const RenderedState before = state().rendered;
            ImGui::GetBackgroundDrawList()->AddImage((ImTextureID)picture_texture, {0, 0}, ImGui::GetIO().DisplaySize);
            draw_interface(theme_, facts(), state(), interface_, replay_);
            const bool changed = invalidation(before, state().rendered) != Invalidation::nothing;
            settings_held_ = ImGui::IsAnyItemActive() && (settings_held_ || changed);
            move_camera(passed);
            ImGui::Render();
        }
        state().interacting = hand_.moving() || settings_held_;
        state().keeps_hidden = interface_.replay;
        loop_->step(now);
        if (asked_) {  // once both panels have been told of the picture
            replay_.ask(*loop_, *std::exchange(asked_, {}));
        }
        for (const std::string& error : loop_->take_errors()) {
            report(error);
        }
        try {
            if (input_.width > 0) {
                draw();
            }
            grant_wishes();
            const bool lost = loop_->has(Panel::vulkan) && loop_->shot(Panel::vulkan)->device_lost;
            if (lost) {
                recover();
            }
        } catch (const DeviceLost&) {
            recover();
        }
        log_.follow(facts(), state(), interface_, now);
    }
    log_.write("quit");
    return interrupt.requested();
}

}  // namespace

int show_window(const WindowOptions& options, LoadedScene scene) {
    return ViewWindow(options, std::move(scene)).run() ? exit_interrupted : exit_done;
}

}  // namespace diptych::app
