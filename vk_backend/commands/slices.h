// A render cut into submissions, none of which takes long.
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

/// What one does: some pixels, some samples of each.
struct Slice {
    Region region;
    std::uint32_t first_sample = 0;
    std::uint32_t sample_count = 0;

    std::uint64_t work() const { return std::uint64_t{region.width} * region.height * sample_count; }
};

/// Walks every (pixel, sample) of a region once: several samples of the whole region, or one sample of some rows, or of
/// a part of a row, as the budget of each step allows. A pixel's samples come in order.
class SliceCursor {
public:
    SliceCursor(Region region, std::uint32_t first_sample, std::uint32_t sample_count);

    bool done() const { return remaining_ == 0 || region_.width == 0 || region_.height == 0; }
    /// The next slice, of at most max(1, budget) pixel samples and max(1, pixel_limit) pixels. Must not be done.
    Slice next(std::uint64_t budget, std::uint64_t pixel_limit);

private:
    Region region_;
    std::uint32_t sample_;
    std::uint32_t remaining_;
    std::uint32_t x_ = 0;  // where within the region the current sample stands
    std::uint32_t y_ = 0;
};

/// How much work fits the time of one dispatch, learned from dispatches done.
class SpeedEstimate {
public:
    /// Starts from a small budget, for a device of unknown speed.
    explicit SpeedEstimate(double target_seconds = 0.06, std::uint64_t first_budget = 4096);

    std::uint64_t budget() const { return budget_; }
    /// From now on, dispatches of so many seconds.
    void aim(double target_seconds);
    /// Nothing from no work.
    void learn(std::uint64_t work, double seconds);

private:
    std::uint64_t wanted() const;

    double target_seconds_;
    double seconds_per_work_ = 0;
    std::uint64_t budget_;
};

}  // namespace diptych::core
