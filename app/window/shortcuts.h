// What the keys do: one table, which the keyboard and the page of help both read.
#pragma once

#include <optional>
#include <span>

#include "window/window.h"

namespace diptych::core::app {

enum class Command {
    hide_interface,
    help,
    next_panel,
    next_layer,
    previous_layer,
    next_integrator,
    previous_integrator,
    next_tonemap,
    brighter,
    darker,
    focus,
    reset_camera,
    play,
    screenshot,
    save_exr,
    copy_command,
    close,
    quit,
};

struct Shortcut {
    Command command;
    int key;  // GLFW_KEY_*
    bool ctrl;
    bool shift;
    const char* keys;  // as the help shows them
    const char* text;  // empty where an earlier line speaks for both
};

std::span<const Shortcut> shortcuts();

/// What a press asks for.
std::optional<Command> command_of(const KeyPress& press);

/// The scene's camera that a number key stands for, from 0.
std::optional<int> camera_of(const KeyPress& press);

/// What the mouse and held keys do, as the help shows it.
struct Gesture {
    const char* hand;
    const char* text;
};
std::span<const Gesture> gestures();

}  // namespace diptych::core::app
