// Messages over MPI.
#pragma once

#include <mpi.h>

#include <deque>
#include <vector>

#include "ranks/channel.h"

namespace diptych::core {

class MpiChannel final : public RankChannel {
public:
    /// Starts MPI.
    MpiChannel();
    RankPlace place() const override { return place_; }
    void send(int to, std::uint32_t kind, std::vector<std::uint32_t> words) override;
    std::optional<Message> receive() override;
    std::size_t pending_words(int to) const override;
    void leave() override;

private:
    struct Sending {
        int to;
        std::vector<std::uint32_t> words;
        MPI_Request request;
    };
    struct Receiving {
        Message message;
        MPI_Request request;
    };

    void begin_receives();
    void drop_sent();

    RankPlace place_;
    std::deque<Sending> sending_;
    std::vector<std::deque<Receiving>> receiving_;  // by sender, in its order
    std::size_t next_sender_ = 0;
};

}  // namespace diptych::core
