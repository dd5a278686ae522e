// How much of a picture fits a frame.
#include "view/frame_budget.h"

#include "catch.h"

using namespace diptych::core::app;

namespace {

constexpr double frame = 1.0 / 60;
constexpr int width = 1920;
constexpr int height = 1080;

/// A panel that takes so many samples of the whole picture a frame.
PanelSpeed fits(double samples) {
    return {.samples_per_second = samples * width * height / frame, .overhead_seconds = 0};
}

}  // namespace

TEST_CASE("At rest the picture is whole and samples fill the frame", "[view]") {
    const FrameBudget fast = frame_budget(fits(3.4), width, height, frame, false, 8);
    CHECK(fast.divisor == 1);
    CHECK(fast.samples == 3);
    const FrameBudget slow = frame_budget(fits(0.01), width, height, frame, false, 8);
    CHECK(slow.divisor == 1);
    CHECK(slow.samples == 1);
    const FrameBudget unknown = frame_budget({}, width, height, frame, false, 1);
    CHECK(unknown.divisor == 1);
    CHECK(unknown.samples == 1);
    CHECK(frame_budget(fits(1e9), width, height, frame, false, 1).samples == 4096);
}

TEST_CASE("Moving takes the finest preview whose sample fits", "[view]") {
    CHECK(frame_budget(fits(2.5), width, height, frame, true, 1).divisor == 1);
    CHECK(frame_budget(fits(2.5), width, height, frame, true, 1).samples == 2);
    CHECK(frame_budget(fits(0.3), width, height, frame, true, 8).divisor ==
          3);  // 0.25 would do, but not with a fifth to spare
    CHECK(frame_budget(fits(0.3), width, height, frame, true, 2).divisor == 2);
    CHECK(frame_budget(fits(0.03), width, height, frame, true, 1).divisor == 6);
    CHECK(frame_budget(fits(1e-6), width, height, frame, true, 1).divisor == 8);
    CHECK(frame_budget({}, width, height, frame, true, 1).divisor == 8);
}

TEST_CASE("A preview stays as fine as it is while the speed wavers", "[view]") {
    int divisor = 8;
    int changes = 0;
    for (int i = 0; i < 100; ++i) {
        const double samples = 0.27 * (i % 2 == 0 ? 1.05 : 0.95);
        const int next = frame_budget(fits(samples), width, height, frame, true, divisor).divisor;
        changes += next != divisor ? 1 : 0;
        divisor = next;
    }
    CHECK(changes == 1);
}

TEST_CASE("What comes before the first sample is taken off the frame", "[view]") {
    PanelSpeed speed = fits(1.5);
    CHECK(frame_budget(speed, width, height, frame, true, 1).divisor == 1);
    speed.overhead_seconds = frame / 2;
    CHECK(frame_budget(speed, width, height, frame, true, 1).divisor == 2);
    speed.overhead_seconds = 10 * frame;  // even then something is shown
    CHECK(frame_budget(speed, width, height, frame, true, 1).divisor == 3);
}

TEST_CASE("Previews of the smallest pictures have a pixel", "[view]") {
    CHECK(preview_side(1, 8) == 1);
    CHECK(preview_side(9, 8) == 2);
    CHECK(preview_side(16, 8) == 2);
    CHECK(frame_budget({.samples_per_second = 1e9}, 1, 1, frame, true, 1).divisor == 1);
}
