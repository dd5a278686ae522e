#include "window/shortcuts.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>

namespace diptych::core::app {

namespace {

constexpr std::array all_shortcuts = {
    Shortcut{Command::hide_interface, GLFW_KEY_TAB, false, false, "Tab", "hide or show the interface"},
    Shortcut{Command::help, GLFW_KEY_H, false, false, "H", "this page"},
    Shortcut{Command::help, GLFW_KEY_F1, false, false, "", ""},
    Shortcut{Command::next_panel, GLFW_KEY_P, false, false, "P", "next panel"},
    Shortcut{Command::next_layer, GLFW_KEY_L, false, false, "L", "next layer; Shift: previous layer"},
    Shortcut{Command::previous_layer, GLFW_KEY_L, false, true, "", ""},
    Shortcut{Command::next_integrator, GLFW_KEY_I, false, false, "I", "next integrator; Shift: previous one"},
    Shortcut{Command::previous_integrator, GLFW_KEY_I, false, true, "", ""},
    Shortcut{Command::next_tonemap, GLFW_KEY_T, false, false, "T", "next tone map"},
    Shortcut{Command::darker, GLFW_KEY_LEFT_BRACKET, false, false, "[  ]", "darker, brighter by a quarter EV"},
    Shortcut{Command::brighter, GLFW_KEY_RIGHT_BRACKET, false, false, "", ""},
    Shortcut{Command::focus, GLFW_KEY_F, false, false, "F", "focus on the point under the pointer, orbit about it"},
    Shortcut{Command::reset_camera, GLFW_KEY_R, false, false, "R", "reset the camera; 1 to 9: the scene's cameras"},
    Shortcut{Command::play, GLFW_KEY_SPACE, false, false, "Space", "play or pause the animation"},
    Shortcut{Command::screenshot, GLFW_KEY_S, true, false, "Ctrl+S", "save the picture as PNG; Shift: radiance as EXR"},
    Shortcut{Command::save_exr, GLFW_KEY_S, true, true, "", ""},
    Shortcut{Command::copy_command, GLFW_KEY_C, true, false, "Ctrl+C", "copy the command that renders this picture"},
    Shortcut{Command::close, GLFW_KEY_ESCAPE, false, false, "Esc", "close messages, replay and this page"},
    Shortcut{Command::quit, GLFW_KEY_Q, true, false, "Ctrl+Q", "quit"},
};

constexpr std::array all_gestures = {
    Gesture{"Left drag", "orbit"},
    Gesture{"Right drag", "look around"},
    Gesture{"Middle drag", "pan; also Shift + left drag"},
    Gesture{"Wheel", "nearer, farther"},
    Gesture{"W A S D Q E", "fly; Shift: four times as fast"},
    Gesture{"Click", "replay a path of that pixel on both panels"},
    Gesture{"Ctrl+click a slider", "type a number"},
    Gesture{"Drop a file", "open a .gltf or .glb; .hdr or .exr: as the sky"},
};

}  // namespace

std::span<const Shortcut> shortcuts() {
    return all_shortcuts;
}

std::span<const Gesture> gestures() {
    return all_gestures;
}

std::optional<Command> command_of(const KeyPress& press) {
    const auto found = std::find_if(all_shortcuts.begin(), all_shortcuts.end(), [&](const Shortcut& shortcut) {
        return shortcut.key == press.key && shortcut.ctrl == press.ctrl && shortcut.shift == press.shift && !press.alt;
    });
    return found == all_shortcuts.end() ? std::nullopt : std::optional(found->command);
}

std::optional<int> camera_of(const KeyPress& press) {
    const bool number = press.key >= GLFW_KEY_1 && press.key <= GLFW_KEY_9 && !press.ctrl && !press.shift && !press.alt;
    return number ? std::optional(press.key - GLFW_KEY_1) : std::nullopt;
}

}  // namespace diptych::core::app
