// A view without a window: the same frames, timed.
#pragma once

#include <string>

#include "view/loader.h"
#include "view/view_state.h"

namespace diptych::core::app {

struct HeadlessOptions {
    ShownPanel panel = ShownPanel::cpu;
    std::uint32_t frames = 120;
    double frames_per_second = 60;
    std::string output;  // the last picture; empty: none
    bool json = false;
};

/// Orbits for half of the frames, rests for the others, and says how long they took. Each frame ends when the samples
/// that it asked for are there and, where there is a Vulkan device, on its picture. Returns the exit code. Throws
/// Error, NoDevice.
int run_headless(const HeadlessOptions& options, LoadedScene scene);

}  // namespace diptych::core::app
