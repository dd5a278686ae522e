// Work in flight on the device, and the time it took there.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "commands/commands.h"

namespace diptych::core {

/// A stretch of a submission, timed by itself.
struct TimedPart {
    std::size_t label = 0;
    Record record;
};

/// Keeps two submissions in flight. Each starts after the one before it, which it may read from and write over.
class TimedQueue {
public:
    /// `finished(work, seconds)` is called in order, as submissions end.
    using Finished = std::function<void(std::uint64_t, double)>;

    explicit TimedQueue(const Gpu& gpu, Finished finished = {});

    static constexpr std::size_t most_parts = 128;  // of one submission

    /// Submits; waits first for the older of two in flight.
    void submit(std::uint64_t work, const Record& record);
    void submit(std::uint64_t work, std::span<const TimedPart> parts);
    /// Waits for all.
    void drain();
    /// Device time of all that has ended: by timestamps where the queue has them.
    double seconds() const { return seconds_; }
    /// Likewise of all parts under a label; 0 where the queue has no timestamps.
    double seconds_of(std::size_t label) const { return label < by_label_.size() ? by_label_[label] : 0; }
    /// Labels mean something else from now on. Nothing may be in flight.
    void forget_labels() { by_label_.clear(); }

private:
    struct Slot {
        CommandSlot commands;
        vk::raii::QueryPool queries;
        std::uint64_t work = 0;
        std::vector<std::size_t> labels;  // of its parts
        double submitted = 0;  // by now_seconds
    };

    Slot make_slot() const;
    void finish(Slot& slot);

    const Gpu& gpu_;
    Finished finished_;
    std::array<Slot, 2> slots_;
    std::size_t next_ = 0;
    double seconds_ = 0;
    std::vector<double> by_label_;
    double last_end_ = 0;  // by now_seconds
};

}  // namespace diptych::core
