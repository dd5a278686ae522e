// The thread of a rank that sends and receives.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "ranks/channel.h"

namespace diptych::core {

struct PostHooks {
    std::function<void(const Message&)> message;  // in the post's thread, as the others are
    std::function<void()> tick;                   // some times a second
    std::function<void(const std::string& reason)> broken;  // nothing can be sent or received any more
};

/// A rank may send to itself too.
class Post {
public:
    Post(std::unique_ptr<RankChannel> channel, PostHooks hooks);
    ~Post();
    Post(const Post&) = delete;
    Post& operator=(const Post&) = delete;

    const RankPlace& place() const { return place_; }
    /// From any thread.
    void send(int to, std::uint32_t kind, std::vector<std::uint32_t> words);
    /// Words that have not left for that rank yet.
    std::size_t pending_words(int to) const;
    /// Sends what is left, stops the thread and leaves with the others; with `alone` it does not wait for them.
    void leave(bool alone);

private:
    void run();
    bool exchange();

    std::unique_ptr<RankChannel> channel_;
    RankPlace place_;
    PostHooks hooks_;
    mutable std::mutex mutex_;
    std::condition_variable has_work_;
    std::deque<Message> out_;  // `from` is the receiver
    std::vector<std::size_t> pending_;
    bool leaving_ = false;
    std::thread thread_;
};

}  // namespace diptych::core
