#include "timed_queue.h"

#include <algorithm>

namespace diptych {

TimedQueue::TimedQueue(const Gpu& gpu, Finished finished)
    : gpu_(gpu), finished_(std::move(finished)), slots_{make_slot(), make_slot()} {}

TimedQueue::Slot TimedQueue::make_slot() const {
    return {.commands = CommandSlot(gpu_),
            .queries = gpu_.device.createQueryPool({.queryType = vk::QueryType::eTimestamp, .queryCount = 2}),
            .work = 0,
            .submitted = {}};
}

void TimedQueue::submit(std::uint64_t work, const Record& record) {
    Slot& slot = slots_[next_];
    next_ = (next_ + 1) % slots_.size();
    finish(slot);
    slot.work = work;
    slot.submitted = Clock::now();
    slot.commands.submit([&](const vk::raii::CommandBuffer& commands) {
        const bool timed = gpu_.tick_seconds > 0;
        full_barrier(commands);
        // Both at the bottom of the pipe: the first is then written when all earlier work has ended.
        if (timed) {
            commands.resetQueryPool(*slot.queries, 0, 2);
            commands.writeTimestamp(vk::PipelineStageFlagBits::eBottomOfPipe, *slot.queries, 0);
        }
        record(commands);
        if (timed) {
            commands.writeTimestamp(vk::PipelineStageFlagBits::eBottomOfPipe, *slot.queries, 1);
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
    const Clock::time_point end = Clock::now();
    double elapsed = std::chrono::duration<double>(end - std::max(slot.submitted, last_end_)).count();
    last_end_ = end;
    if (gpu_.tick_seconds > 0) {
        const auto ticks = slot.queries
                               .getResults<std::uint64_t>(0, 2, 2 * sizeof(std::uint64_t), sizeof(std::uint64_t),
                                                          vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait)
                               .second;
        elapsed = static_cast<double>((ticks[1] - ticks[0]) & gpu_.tick_mask) * gpu_.tick_seconds;
    }
    seconds_ += elapsed;
    if (finished_) {
        finished_(slot.work, elapsed);
    }
}

}  // namespace diptych
