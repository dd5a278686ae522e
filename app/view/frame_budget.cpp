#include "view/frame_budget.h"

#include <algorithm>
#include <cmath>

namespace diptych::core::app {

namespace {

constexpr double most_samples = 4096;
constexpr double spare = 0.8;

double pixels_of(int width, int height, int divisor) {
    return static_cast<double>(preview_side(width, divisor)) * preview_side(height, divisor);
}

std::uint32_t samples_in(double seconds, double samples_per_second, double pixels) {
    return static_cast<std::uint32_t>(std::clamp(seconds * samples_per_second / pixels, 1.0, most_samples));
}

}  // namespace

int preview_side(int side, int divisor) {
    return std::max(1, (side + divisor - 1) / divisor);
}

FrameBudget frame_budget(const PanelSpeed& speed, int width, int height, double frame_seconds, bool moving,
                         int present) {
    if (!moving) {
        return {samples_in(frame_seconds, speed.samples_per_second, pixels_of(width, height, 1)), 1};
    }
    // Where all of a frame goes into getting ready, the picture is late whatever its size.
    const double left = std::max(frame_seconds - speed.overhead_seconds, 0.1 * frame_seconds);
    for (const int divisor : preview_divisors) {
        const double seconds = divisor < present ? spare * left : left;
        const double pixels = pixels_of(width, height, divisor);
        if (seconds * speed.samples_per_second >= pixels) {
            return {samples_in(seconds, speed.samples_per_second, pixels), divisor};
        }
    }
    return {1, preview_divisors.back()};
}

}  // namespace diptych::core::app
