// Work in flight on the device, and the time it took there.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>

#include "commands.h"

namespace diptych {

/// Keeps two submissions in flight. Each starts after the one before it, which it may read from and write over.
class TimedQueue {
public:
    /// `finished(work, seconds)` is called in order, as submissions end.
    using Finished = std::function<void(std::uint64_t, double)>;

    explicit TimedQueue(const Gpu& gpu, Finished finished = {});

    /// Submits; waits first for the older of two in flight.
    void submit(std::uint64_t work, const Record& record);
    /// Waits for all.
    void drain();
    /// Device time of all that has ended: by timestamps where the queue has them.
    double seconds() const { return seconds_; }

private:
    using Clock = std::chrono::steady_clock;
    struct Slot {
        CommandSlot commands;
        vk::raii::QueryPool queries;
        std::uint64_t work = 0;
        Clock::time_point submitted;
    };

    Slot make_slot() const;
    void finish(Slot& slot);

    const Gpu& gpu_;
    Finished finished_;
    std::array<Slot, 2> slots_;
    std::size_t next_ = 0;
    double seconds_ = 0;
    Clock::time_point last_end_;
};

}  // namespace diptych
