// What hands and controls ask of a view, and the answers.
#include "window/open_view.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <filesystem>
#include <utility>

#include "error.h"
#include "image/image_file.h"
#include "window/view_commands.h"

namespace diptych::core::app {

void OpenView::read_input(double timeout) {
    input_ = window_.poll(timeout);
    if (imgui_.fit(input_, options_.interface_scale)) {
        presenter_->reload_font();
    }
    for (const KeyPress& press : input_.keys) {
        if (press.ctrl) {
            chords_.insert(press.key);
        } else if (!press.repeated) {
            chords_.erase(press.key);
        }
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

void OpenView::take_drops() {
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

void OpenView::move_camera(double seconds) {
    const ImGuiIO& io = ImGui::GetIO();
    const auto flies = [&](int key) { return window_.holds(key) && chords_.count(key) == 0; };
    const auto axis = [&](int positive, int negative) {
        return (flies(positive) ? 1.0 : 0.0) - (flies(negative) ? 1.0 : 0.0);
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

void OpenView::grant_wishes() {
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
        focus_point_ = input_.cursor / glm::dvec2(std::max(input_.width, 1), std::max(input_.height, 1));
        focus_film_ = loop_->worker(main_panel())->film();
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

void OpenView::save_picture() {
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

void OpenView::save_radiance() {
    if (!saver_.waiting()) {
        saver_.await(loop_->worker(main_panel())->film(),
                     next_picture(options_.folder, loop_->scene().request.scene, ".exr"));
    }
}

/// What the panels were asked for and have answered.
void OpenView::take_answers() {
    if (replay_.update()) {
        log_.write("replayed", {{"paths", replay_.result().paths.size()},
                                {"parted", replay_.result().parting.has_value()},
                                {"error", replay_.error()}});
    }
    try {
        if (focus_film_.valid() && focus_film_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
            if (focus_at(focus_point_, focus_film_.get(), state())) {
                log_.write("focused", {{"distance", state().rendered.camera.lens.focus_distance}});
            } else {
                say("nothing to focus on under the pointer");
            }
        }
        if (const std::optional<std::filesystem::path> saved = saver_.save()) {
            say("saved " + saved->string());
            log_.write("saved", {{"file", saved->string()}});
        }
    } catch (const Error& error) {
        report(error.what());
    }
}

}  // namespace diptych::core::app
