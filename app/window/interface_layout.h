// Where the parts of the interface stand, so that none covers another.
#pragma once

#include "window/interface.h"

namespace diptych::core::app {

struct Box {
    ImVec2 at;
    ImVec2 size;
};

/// Of a window of `size` pixels.
struct Layout {
    Box bar;       // along the top
    Box settings;  // on the left; its height is the most that it may have
    Box figures;   // on the right, likewise
    Box replay;    // on the right, in place of the figures
    Box middle;    // what is left between them, below the bar
};

/// Whether there is room for panels on both sides.
bool is_wide(const Theme& theme, ImVec2 size);

Layout layout_of(const Theme& theme, const InterfaceState& interface, ImVec2 size);

/// A panel that stands where it is told to: its height follows its content up to the box's. End it with ImGui::End.
void begin_panel(const char* name, const Box& box);

}  // namespace diptych::core::app
