#include "commands/slices.h"

#include <algorithm>

namespace diptych::core {

SliceCursor::SliceCursor(Region region, std::uint32_t first_sample, std::uint32_t sample_count)
    : region_(region), sample_(first_sample), remaining_(sample_count) {}

Slice SliceCursor::next(std::uint64_t budget, std::uint64_t pixel_limit) {
    const std::uint64_t pixels = std::uint64_t{region_.width} * region_.height;
    Slice slice{.region = {region_.x + x_, region_.y + y_, region_.width, region_.height},
                .first_sample = sample_,
                .sample_count = 1};
    const bool at_start = x_ == 0 && y_ == 0;
    if (at_start && pixels <= budget && pixels <= pixel_limit) {
        slice.sample_count = static_cast<std::uint32_t>(std::min<std::uint64_t>(budget / pixels, remaining_));
        sample_ += slice.sample_count;
        remaining_ -= slice.sample_count;
        return slice;
    }
    const std::uint64_t allowed = std::max<std::uint64_t>(1, std::min(budget, pixel_limit));
    if (x_ == 0 && allowed >= region_.width) {
        slice.region.height =
            static_cast<std::uint32_t>(std::min<std::uint64_t>(allowed / region_.width, region_.height - y_));
        y_ += slice.region.height;
    } else {
        slice.region.width = static_cast<std::uint32_t>(std::min<std::uint64_t>(allowed, region_.width - x_));
        slice.region.height = 1;
        x_ += slice.region.width;
        if (x_ == region_.width) {
            x_ = 0;
            ++y_;
        }
    }
    if (y_ == region_.height) {
        y_ = 0;
        ++sample_;
        --remaining_;
    }
    return slice;
}

SpeedEstimate::SpeedEstimate(double target_seconds, std::uint64_t first_budget)
    : target_seconds_(target_seconds), budget_(first_budget) {}

std::uint64_t SpeedEstimate::wanted() const {
    return static_cast<std::uint64_t>(std::clamp(target_seconds_ / seconds_per_work_, 1.0, 1e12));
}

void SpeedEstimate::aim(double target_seconds) {
    target_seconds_ = target_seconds;
    if (seconds_per_work_ > 0) {
        budget_ = std::min(wanted(), budget_ * 8);
    }
}

// The estimate falls to no less than half in one step, because cheap parts of an image may be followed by expensive
// ones. The budget grows by no more than a factor of eight.
void SpeedEstimate::learn(std::uint64_t work, double seconds) {
    if (work == 0) {
        return;
    }
    const double measured = std::max(seconds, 1e-9) / static_cast<double>(work);
    seconds_per_work_ = std::max(measured, seconds_per_work_ * 0.5);
    budget_ = std::min(wanted(), std::max(budget_, work) * 8);
}

}  // namespace diptych::core
