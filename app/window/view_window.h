// `diptych view` in a window.
#pragma once

#include <string>

#include "view/loader.h"
#include "view/view_state.h"

namespace diptych::core::app {

struct WindowOptions {
    ShownPanel panel = ShownPanel::split;
    int width = 1280;  // of the window
    int height = 720;
    double scale = 1;           // film pixels over pixels of the window
    float interface_scale = 0;  // 0: the display's own
    double frames_per_second = 60;
    std::string log;           // file for one JSON line an event, "-" is stdout; empty: none
    std::string folder = ".";  // of screenshots
};

/// Shows the scene until the window is closed; returns the exit code. Throws NoDevice where there is no display or no
/// device that can show anything on it.
int show_window(const WindowOptions& options, LoadedScene scene);

}  // namespace diptych::core::app
