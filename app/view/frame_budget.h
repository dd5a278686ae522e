// How much of a picture fits a frame.
#pragma once

#include <array>
#include <cstdint>

namespace diptych::core::app {

/// What previews divide width and height by.
inline constexpr std::array<int, 6> preview_divisors = {1, 2, 3, 4, 6, 8};

struct FrameBudget {
    std::uint32_t samples = 1;  // a pixel, in one go
    int divisor = 1;
};

/// What is known of a panel.
struct PanelSpeed {
    double samples_per_second = 0;  // over all pixels; 0 is not known
    double overhead_seconds = 0;    // before the first sample of a frame that moves
};

/// At rest: the whole size, and as many samples as fit `frame_seconds`, one at least. Moving: the least divisor at
/// which one sample fits, and then likewise; one that is finer than `present` must fit with a fifth to spare, so that
/// the picture does not flicker between two sizes. Where the speed is not known, moving gets the coarsest and rest one
/// sample.
FrameBudget frame_budget(const PanelSpeed& speed, int width, int height, double frame_seconds, bool moving,
                         int present);

/// Width or height of a preview; at least 1.
int preview_side(int side, int divisor);

}  // namespace diptych::core::app
