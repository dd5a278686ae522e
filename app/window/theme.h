// How the interface looks: one type scale, one unit of space, one accent.
#pragma once

#include <imgui.h>

namespace diptych::core::app {

/// Lengths in units of the window, colours as display values.
struct Theme {
    float scale = 1;    // 2 on a display of twice the usual density
    float unit = 4;     // all spaces are multiples of it
    float label = 96;   // width of a column of labels
    float panel = 264;  // width of a side panel
    float bar = 44;     // height of the top bar
    ImFont* body = nullptr;
    ImFont* strong = nullptr;  // headings and figures that matter
    ImFont* small = nullptr;   // units and notes

    float units(float count) const { return unit * count; }
};

namespace colors {
inline const ImVec4 panel{0.055F, 0.063F, 0.075F, 0.93F};
inline const ImVec4 line{1, 1, 1, 0.09F};
inline const ImVec4 field{1, 1, 1, 0.07F};
inline const ImVec4 field_hovered{1, 1, 1, 0.13F};
inline const ImVec4 text{0.93F, 0.94F, 0.95F, 1};
inline const ImVec4 muted{0.62F, 0.65F, 0.69F, 1};
inline const ImVec4 accent{0.31F, 0.63F, 0.93F, 1};
inline const ImVec4 accent_dim{0.31F, 0.63F, 0.93F, 0.55F};
// Signals, for what is right or wrong; nothing else has these colours.
inline const ImVec4 good{0.36F, 0.78F, 0.47F, 1};
inline const ImVec4 doubtful{0.95F, 0.73F, 0.25F, 1};
inline const ImVec4 bad{0.95F, 0.38F, 0.35F, 1};
// The two panels, wherever they stand side by side.
inline const ImVec4 cpu{0.96F, 0.67F, 0.36F, 1};
inline const ImVec4 vulkan{0.46F, 0.78F, 0.96F, 1};
}  // namespace colors

/// Fonts and style of the current context at that scale; the font atlas is built anew, for a framebuffer of `ratio`
/// pixels a unit of the window.
Theme apply_theme(float scale, float ratio);

}  // namespace diptych::core::app
