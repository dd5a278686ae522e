// Messages between the processes of one render.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace diptych::core {

struct Message {
    int from = 0;
    std::uint32_t kind = 0;
    std::vector<std::uint32_t> words;
};

/// Where a rank stands among the others.
struct RankPlace {
    int rank = 0;
    int size = 1;
    int local_rank = 0;  // among the ranks on its host
    int processors = 1;  // that its launcher has left to it
    int sharing = 1;     // ranks on its host, itself included, that may run on one of these
    std::string host;    // as a user knows it
};

/// Used by one thread at a time. Functions throw std::runtime_error with the reason.
class RankChannel {
public:
    virtual ~RankChannel() = default;
    virtual RankPlace place() const = 0;
    /// Begins to send. A message to a rank that has died is lost, or never leaves.
    virtual void send(int to, std::uint32_t kind, std::vector<std::uint32_t> words) = 0;
    /// The next message that has come, in the order in which its sender sent it. None comes from this rank.
    virtual std::optional<Message> receive() = 0;
    /// Words of messages that have not left yet.
    virtual std::size_t pending_words(int to) const = 0;
    /// Waits for all others to leave too. A channel that is destroyed without it leaves alone, as after a death.
    virtual void leave() = 0;
};

}  // namespace diptych::core
