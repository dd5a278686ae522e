// Rank 0's head: hands out blocks, notices who has died, and says when films are added up.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "ranks/channel.h"
#include "ranks/ledger.h"
#include "ranks/orders.h"

namespace diptych::core {

struct CoordinatorHooks {
    std::function<void(int to, Tell, std::vector<std::uint32_t>)> send;
    std::function<void(const std::string& line)> warn;
    std::function<void(const std::string& text)> note;
    /// Takes over the samples of a rank that has lost them, as far as they are on the disk; returns those.
    std::function<SampleRanges(int rank)> adopt = [](int) { return SampleRanges(); };
    /// Whether a process of this host has ended.
    std::function<bool(std::uint64_t process)> has_ended = [](std::uint64_t) { return false; };
};

struct Work {
    SampleRanges wanted;
    LedgerLimits limits;
    bool merges = true;     // samples, whose films are added up at the end; frames are not
    std::string unit = "samples per pixel";
    std::string picture;    // Ready::picture of the ranks that may take part
};

/// Holds no thread: it is told of messages and of the time, and answers by its hooks.
class Coordinator {
public:
    /// A rank that is silent for longer has died.
    static constexpr double longest_silence = 30;

    Coordinator(RankPlace place, CoordinatorHooks hooks, double now);

    void start(Work work, double now);
    void handle(const Message& message, double now);
    /// To be called some times a second.
    void tick(double now);
    /// Tells all ranks to leave.
    void end(int code);

    struct State {
        std::uint64_t finished = 0;  // units
        SampleRanges samples;        // these
        int ranks = 0;
        std::uint64_t left = 0;
        double seconds = 0;  // from the start to now, or to the last block's end
        int parts_saved = 0;  // ranks that have written what they had
        std::uint64_t units_saved = 0;
        bool anyone_died = false;
        std::map<std::string, int> devices;  // of the ranks that rendered, with their number
    };
    State state(double now) const;

private:
    struct Rank {
        Hello hello;
        std::optional<Ready> ready;
        bool asks = false;    // waits for an order
        bool merges = false;  // has the order of this attempt
        bool saved = false;
        bool gone = false;     // has died
        bool retired = false;  // lives, but renders no more
        double heard = 0;
        std::string excuse;  // why it gave up, before rank 0 was there to care
    };
    enum class Phase { waiting, rendering, merging, finished, stopping };

    Rank& at(int rank) { return ranks_[static_cast<std::size_t>(rank)]; }
    const Rank& at(int rank) const { return ranks_[static_cast<std::size_t>(rank)]; }
    std::string name(int rank) const;
    void order(int rank, const Order& order);
    void check_picture(int rank);
    void answer(double now);
    void answer_rank(int rank, double now);
    void begin_merge();
    void lose(int rank, const std::string& how);
    void stop(int code);
    void check_saved();

    RankPlace place_;
    CoordinatorHooks hooks_;
    Work work_;
    Ledger ledger_;
    std::vector<Rank> ranks_;
    Phase phase_ = Phase::waiting;
    double begin_ = 0;
    double end_ = 0;
    std::uint64_t attempt_ = 0;
    std::vector<int> merging_;
    int stop_code_ = 0;
    State saved_;
};

}  // namespace diptych::core
