#include "ranks/post.h"

#include <algorithm>
#include <chrono>

#include "clock.h"

namespace diptych::core {

namespace {

constexpr double tick_seconds = 0.25;
// MPI moves its messages only while it is called.
constexpr auto idle_pause = std::chrono::microseconds(1000);
constexpr auto busy_pause = std::chrono::microseconds(50);
constexpr double longest_farewell = 5;  // seconds for the last messages to leave

}  // namespace

Post::Post(std::unique_ptr<RankChannel> channel, PostHooks hooks)
    : channel_(std::move(channel)), place_(channel_->place()), hooks_(std::move(hooks)),
      pending_(static_cast<std::size_t>(place_.size)) {
    thread_ = std::thread([this] {
        try {
            run();
        } catch (const std::exception& error) {
            hooks_.broken(error.what());
        }
    });
}

Post::~Post() {
    leave(true);
}

void Post::send(int to, std::uint32_t kind, std::vector<std::uint32_t> words) {
    const std::lock_guard lock(mutex_);
    pending_[static_cast<std::size_t>(to)] += words.size();
    out_.push_back({to, kind, std::move(words)});
    has_work_.notify_one();
}

std::size_t Post::pending_words(int to) const {
    const std::lock_guard lock(mutex_);
    return pending_[static_cast<std::size_t>(to)];
}

/// Returns whether anything moved, or is on its way.
bool Post::exchange() {
    std::deque<Message> out;
    {
        const std::lock_guard lock(mutex_);
        out.swap(out_);
    }
    bool busy = !out.empty();
    for (Message& message : out) {
        if (message.from == place_.rank) {
            hooks_.message(message);
        } else {
            channel_->send(message.from, message.kind, std::move(message.words));
        }
    }
    while (const std::optional<Message> message = channel_->receive()) {
        busy = true;
        hooks_.message(*message);
    }
    const std::lock_guard lock(mutex_);
    for (int rank = 0; rank < place_.size; ++rank) {
        std::size_t words = channel_->pending_words(rank);
        for (const Message& message : out_) {
            words += message.from == rank ? message.words.size() : 0;
        }
        pending_[static_cast<std::size_t>(rank)] = words;
        busy = busy || words > 0;
    }
    return busy;
}

void Post::run() {
    double next_tick = 0;
    double leave_at = 0;
    for (;;) {
        const bool busy = exchange();
        if (const double now = now_seconds(); now >= next_tick) {
            next_tick = now + tick_seconds;
            hooks_.tick();
        }
        std::unique_lock lock(mutex_);
        if (leaving_ && leave_at == 0) {
            leave_at = now_seconds() + longest_farewell;
        }
        const bool all_left = out_.empty() && std::all_of(pending_.begin(), pending_.end(), [](auto n) { return n == 0; });
        if (leaving_ && (all_left || now_seconds() > leave_at)) {
            return;
        }
        has_work_.wait_for(lock, busy ? busy_pause : idle_pause, [&] { return !out_.empty() || (leaving_ && leave_at == 0); });
    }
}

void Post::leave(bool alone) {
    if (!thread_.joinable()) {
        return;
    }
    {
        const std::lock_guard lock(mutex_);
        leaving_ = true;
    }
    has_work_.notify_one();
    thread_.join();
    if (!alone) {
        channel_->leave();
    }
}

}  // namespace diptych::core
