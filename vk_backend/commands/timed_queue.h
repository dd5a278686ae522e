// Submissions in flight, and the device time they take.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "commands/commands.h"

namespace diptych::core {

/// A part of a submission that is timed separately.
struct TimedPart {
    std::size_t label = 0;
    Record record;
};

/// Keeps two submissions in flight. Each runs after the one before it, and may read and overwrite its results.
class TimedQueue {
public:
    /// `finished(work, seconds)` is called in order, when a submission has ended.
    using Finished = std::function<void(std::uint64_t, double)>;

    explicit TimedQueue(const Gpu& gpu, Finished finished = {});

    static constexpr std::size_t most_parts = 128;  // of one submission

    /// Submits. First waits for the older of two submissions in flight.
    void submit(std::uint64_t work, const Record& record);
    void submit(std::uint64_t work, std::span<const TimedPart> parts);
    /// Waits for all submissions.
    void drain();
    /// Device time of all finished submissions; from timestamps if the queue has them.
    double seconds() const { return seconds_; }
    /// Device time of all parts with this label; 0 if the queue has no timestamps.
    double seconds_of(std::size_t label) const { return label < by_label_.size() ? by_label_[label] : 0; }
    /// Resets all times by label, before labels get a new meaning. Nothing may be in flight.
    void forget_labels() { by_label_.clear(); }

private:
    struct Slot {
        vk::raii::QueryPool queries;  // outlives the submission, for whose end `commands` waits
        CommandSlot commands;
        std::uint64_t work = 0;
        std::vector<std::size_t> labels;  // of the submission's parts
        double submitted = 0;  // time of now_seconds
    };

    Slot make_slot() const;
    void finish(Slot& slot);

    const Gpu& gpu_;
    Finished finished_;
    std::array<Slot, 2> slots_;
    std::size_t next_ = 0;
    double seconds_ = 0;
    std::vector<double> by_label_;
    double last_end_ = 0;  // time of now_seconds
};

}  // namespace diptych::core
