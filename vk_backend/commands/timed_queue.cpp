#include "clock.h"
#include "commands/timed_queue.h"

#include <algorithm>
#include <cassert>

namespace diptych::core {

TimedQueue::TimedQueue(const Gpu& gpu, Finished finished)
    : gpu_(gpu), finished_(std::move(finished)), slots_{make_slot(), make_slot()} {}

TimedQueue::Slot TimedQueue::make_slot() const {
    return {.queries =
                gpu_.device.createQueryPool({.queryType = vk::QueryType::eTimestamp, .queryCount = most_parts + 1}),
            .commands = CommandSlot(gpu_),
            .work = 0,
            .labels = {},
            .submitted = {}};
}

void TimedQueue::submit(std::uint64_t work, const Record& record) {
    const TimedPart whole{.record = record};
    submit(work, std::span(&whole, 1));
}

void TimedQueue::submit(std::uint64_t work, std::span<const TimedPart> parts) {
    assert(!parts.empty() && parts.size() <= most_parts);
    Slot& slot = slots_[next_];
    next_ = (next_ + 1) % slots_.size();
    finish(slot);
    slot.work = work;
    slot.labels.clear();
    for (const TimedPart& part : parts) {
        slot.labels.push_back(part.label);
    }
    slot.submitted = now_seconds();
    slot.commands.submit([&](Recorder& recorder) {
        const bool timed = gpu_.tick_seconds > 0;
        const vk::raii::CommandBuffer& commands = recorder;
        // All timestamps are written at the bottom of the pipe: each after all earlier work has ended.
        std::uint32_t query = 0;
        const auto stamp = [&] {
            if (timed) {
                commands.writeTimestamp(vk::PipelineStageFlagBits::eBottomOfPipe, *slot.queries, query++);
            }
        };
        if (timed) {
            commands.resetQueryPool(*slot.queries, 0, static_cast<std::uint32_t>(parts.size()) + 1);
        }
        stamp();
        for (const TimedPart& part : parts) {
            part.record(recorder);
            stamp();
        }
    });
}

void TimedQueue::drain() {
    for (std::size_t i = 0; i < slots_.size(); ++i) {
        finish(slots_[(next_ + i) % slots_.size()]);
    }
}

void TimedQueue::finish(Slot& slot) {
    if (!slot.commands.in_flight()) {
        return;
    }
    slot.commands.wait();
    const double end = now_seconds();
    double elapsed = end - std::max(slot.submitted, last_end_);
    last_end_ = end;
    if (gpu_.tick_seconds > 0) {
        const auto stamps = static_cast<std::uint32_t>(slot.labels.size()) + 1;
        const auto ticks =
            slot.queries
                .getResults<std::uint64_t>(0, stamps, stamps * sizeof(std::uint64_t), sizeof(std::uint64_t),
                                           vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait)
                .second;
        const auto between = [&](std::size_t first, std::size_t last) {
            return static_cast<double>((ticks[last] - ticks[first]) & gpu_.tick_mask) * gpu_.tick_seconds;
        };
        elapsed = between(0, slot.labels.size());
        for (std::size_t i = 0; i < slot.labels.size(); ++i) {
            by_label_.resize(std::max(by_label_.size(), slot.labels[i] + 1));
            by_label_[slot.labels[i]] += between(i, i + 1);
        }
    }
    seconds_ += elapsed;
    if (finished_) {
        finished_(slot.work, elapsed);
    }
}

}  // namespace diptych::core
