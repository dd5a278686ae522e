// Cuts a render into submissions that each take a short time.
#pragma once

#include <cstdint>

namespace diptych::core {

/// Pixels [x, x + width) x [y, y + height).
struct Region {
    std::uint32_t x = 0;
    std::uint32_t y = 0;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
};

/// The work of one submission: some pixels, and some samples of each.
struct Slice {
    Region region;
    std::uint32_t first_sample = 0;
    std::uint32_t sample_count = 0;

    std::uint64_t work() const { return std::uint64_t{region.width} * region.height * sample_count; }
};

/// Visits every (pixel, sample) of a region once. Depending on the budget, a step has several samples of the whole
/// region, one sample of some rows, or one sample of a part of a row. The samples of a pixel are in order.
class SliceCursor {
public:
    SliceCursor(Region region, std::uint32_t first_sample, std::uint32_t sample_count);

    bool done() const { return remaining_ == 0 || region_.width == 0 || region_.height == 0; }
    /// Pixel samples that are left, with those of a started row or picture.
    std::uint64_t left() const { return std::uint64_t{region_.width} * region_.height * remaining_; }
    /// The next slice, with at most max(1, budget) pixel samples and max(1, pixel_limit) pixels. Requires !done().
    Slice next(std::uint64_t budget, std::uint64_t pixel_limit);

private:
    Region region_;
    std::uint32_t sample_;
    std::uint32_t remaining_;
    std::uint32_t x_ = 0;  // position of the current sample within the region
    std::uint32_t y_ = 0;
};

/// Learns from finished dispatches how much work fits into the time of one dispatch.
class SpeedEstimate {
public:
    /// Starts with a small budget, because the device's speed is unknown.
    explicit SpeedEstimate(double target_seconds = 0.06, std::uint64_t first_budget = 4096);

    std::uint64_t budget() const { return budget_; }
    /// Sets the target time of later dispatches.
    void aim(double target_seconds);
    /// Updates the estimate. No work leaves it unchanged.
    void learn(std::uint64_t work, double seconds);

private:
    std::uint64_t wanted() const;

    double target_seconds_;
    double seconds_per_work_ = 0;
    std::uint64_t budget_;
};

}  // namespace diptych::core
