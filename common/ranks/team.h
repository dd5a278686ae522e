// What a render sees of the other ranks.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>

#include "ranks/coordinator.h"
#include "ranks/post.h"

namespace diptych::core {

struct TeamHooks {
    std::function<bool()> interrupted;    // a signal has asked this process to stop
    std::function<int()> interrupt_code;  // the exit code that goes with it
    std::function<void(const std::string& line)> warn;  // rank 0 alone: for its user
    std::function<void(const std::string& text)> note;
};

/// Used by the thread that renders. Functions that wait return early, with the order, where rank 0 has another order.
class Team {
public:
    Team(std::unique_ptr<RankChannel> channel, TeamHooks hooks);

    const RankPlace& place() const { return post_.place(); }
    bool leads() const { return place().rank == 0; }
    /// Set where all are to stop, by a signal to any of them.
    const std::atomic<bool>& cancel() const { return cancel_; }

    /// Rank 0 alone: what there is to do, and CoordinatorHooks::adopt for as long as it is done.
    void start(Work work, std::function<SampleRanges(int rank)> adopt = {});
    Coordinator::State state() const;
    /// All others leave with this exit code.
    void end(int code);

    /// This rank can render.
    void ready(const Ready& ready);
    /// The block before, if there was one, is done; waits for the next order. `waiting` is called now and then.
    Order next(const std::function<void()>& waiting = {});
    /// Rank 0 alone: all films of the attempt are added up. Returns the next order, `finished` where that counts.
    Order merged(std::uint64_t attempt);
    void tell_lost(const std::string& reason);
    void tell_gave_up(const std::string& reason);
    void tell_saved(std::uint64_t samples);
    void tell_note(const std::string& text);
    /// Waits for the order to leave, unless it has come; after tell_saved, or where this rank can do no more.
    Order wait_for_end();
    /// Rank 0 alone, after a stop and tell_saved: waits until all have saved.
    Order wait_for_saved();

    /// Sends words of a film; false where there is another order.
    bool send_film(int to, std::vector<std::uint32_t> words);
    /// Waits for words of the attempt's film from that rank; none where there is another order.
    std::optional<std::vector<std::uint32_t>> receive_film(int from, std::uint64_t attempt);

    /// Ends the conversation; waits for the others where all live.
    void leave(const Order& end);

private:
    std::unique_ptr<Coordinator> make_coordinator(const RankPlace& place);
    PostHooks post_hooks();
    void on_message(const Message& message);
    void on_order(const Order& order);
    void tick();
    Order wait(const std::function<void()>& waiting, const std::function<bool(const Order&)>& wanted);
    void tell(int to, Tell kind, std::vector<std::uint32_t> words = {});

    const TeamHooks hooks_;
    mutable std::mutex mutex_;  // of all below
    std::condition_variable changed_;
    std::unique_ptr<Coordinator> coordinator_;  // on rank 0
    std::function<SampleRanges(int rank)> adopt_;
    std::deque<Order> orders_;
    std::optional<Order> end_;
    std::deque<Message> films_;
    std::atomic<bool> cancel_ = false;
    bool told_interrupt_ = false;
    double heard_ = 0;  // rank 0 by the others
    Post post_;  // the last, so that its thread ends first
};

}  // namespace diptych::core
