// Ranks that are threads of one process.
#pragma once

#include <deque>
#include <memory>
#include <mutex>
#include <vector>

#include "ranks/channel.h"

namespace diptych::core::tests {

struct MemoryExchange {
    explicit MemoryExchange(int ranks) : inboxes(static_cast<std::size_t>(ranks)) {}
    std::mutex mutex;
    std::vector<std::deque<Message>> inboxes;
};

class MemoryChannel final : public RankChannel {
public:
    MemoryChannel(std::shared_ptr<MemoryExchange> exchange, int rank) : exchange_(std::move(exchange)), rank_(rank) {}
    RankPlace place() const override {
        const int size = static_cast<int>(exchange_->inboxes.size());
        return {.rank = rank_, .size = size, .local_rank = rank_, .processors = 1, .sharing = size, .host = "here"};
    }
    void send(int to, std::uint32_t kind, std::vector<std::uint32_t> words) override {
        const std::lock_guard lock(exchange_->mutex);
        exchange_->inboxes[static_cast<std::size_t>(to)].push_back({rank_, kind, std::move(words)});
    }
    std::optional<Message> receive() override {
        const std::lock_guard lock(exchange_->mutex);
        auto& inbox = exchange_->inboxes[static_cast<std::size_t>(rank_)];
        if (inbox.empty()) {
            return std::nullopt;
        }
        Message message = std::move(inbox.front());
        inbox.pop_front();
        return message;
    }
    std::size_t pending_words(int) const override { return 0; }
    void leave() override {}

private:
    std::shared_ptr<MemoryExchange> exchange_;
    int rank_;
};

}  // namespace diptych::core::tests
