// Rank 0's head, message by message.
#include "ranks/coordinator.h"

#include "catch.h"

namespace diptych::core {
namespace {

struct Heard {
    int to;
    Order order;
};

/// A coordinator of three ranks, with what it says.
struct Head {
    std::vector<Heard> heard;
    std::vector<std::string> warnings;
    SampleRanges on_disk;
    std::uint64_t ended = 0;  // a process
    double now = 0;
    Coordinator coordinator;

    Head() : coordinator({.rank = 0, .size = 3, .local_rank = 0, .processors = 1, .sharing = 3, .host = "a"}, hooks(), 0) {
        for (int rank = 0; rank < 3; ++rank) {
            tell(rank, Tell::hello, Hello{"host", "space", 100U + static_cast<unsigned>(rank)}.words());
        }
    }
    CoordinatorHooks hooks() {
        return {.send =
                    [this](int to, Tell kind, const std::vector<std::uint32_t>& words) {
                        if (kind == Tell::order) {
                            heard.push_back({to, Order::of(words)});
                        }
                    },
                .warn = [this](const std::string& line) { warnings.push_back(line); },
                .note = [](const std::string&) {},
                .adopt = [this](int) { return on_disk; },
                .has_ended = [this](std::uint64_t process) { return process == ended; }};
    }
    void tell(int from, Tell kind, std::vector<std::uint32_t> words = {}) {
        now += 0.1;
        coordinator.handle({from, static_cast<std::uint32_t>(kind), std::move(words)}, now);
    }
    void ready(int rank, const std::string& picture = "p") { tell(rank, Tell::ready, Ready{picture, "d"}.words()); }
    void start(std::uint64_t samples) {
        Work work;
        work.wanted = SampleRanges({0, samples});
        work.picture = "p";
        coordinator.start(work, now);
    }
    /// The last order to a rank since the last call; Order::Kind::end with code -1 where there is none.
    Order last(int rank) {
        for (auto i = heard.rbegin(); i != heard.rend(); ++i) {
            if (i->to == rank) {
                const Order order = i->order;
                heard.erase(std::next(i).base());
                return order;
            }
        }
        return {.code = -1};
    }
};

using Kind = Order::Kind;

}  // namespace

TEST_CASE("A rank that dies while films are added up is replaced, and they are added up anew") {
    Head head;
    head.start(3);
    for (int rank = 0; rank < 3; ++rank) {
        head.ready(rank);
        head.tell(rank, Tell::ask);
        CHECK(head.last(rank).kind == Kind::render);
    }
    for (int rank = 0; rank < 3; ++rank) {
        head.tell(rank, Tell::ask);
    }
    for (int rank = 0; rank < 3; ++rank) {
        const Order merge = head.last(rank);
        CHECK(merge.kind == Kind::merge);
        CHECK(merge.attempt == 1);
        CHECK(merge.ranks == std::vector<int>{0, 1, 2});
    }
    head.tell(1, Tell::ask);  // it has sent its film
    head.ended = 102;
    head.coordinator.tick(head.now);
    REQUIRE(head.warnings.size() == 1);
    CHECK(head.warnings[0].find("rank 2 on host (process 102) has died; 0 of its 1 samples") == 0);
    CHECK(head.last(0).kind == Kind::abandon);
    const Order again = head.last(1);  // after the abandoned merge, since it asks
    CHECK(again.kind == Kind::render);
    CHECK(again.block == SampleRange{2, 3});
    // Rank 0 had added up all films when it heard of it: that counts no more.
    head.tell(0, Tell::merged, WordWriter().put(std::uint64_t{1}).take());
    CHECK(head.last(0).code == -1);
    head.tell(1, Tell::ask);
    for (int rank = 0; rank < 2; ++rank) {
        const Order merge = head.last(rank);
        CHECK(merge.kind == Kind::merge);
        CHECK(merge.attempt == 2);
        CHECK(merge.ranks == std::vector<int>{0, 1});
    }
    head.tell(0, Tell::merged, WordWriter().put(std::uint64_t{2}).take());
    CHECK(head.last(0).kind == Kind::finished);
    CHECK(head.coordinator.state(head.now).samples.text() == "0:3");
    CHECK(head.coordinator.state(head.now).anyone_died);
    // A message of the dead, as of a process that was only asleep.
    head.tell(2, Tell::ask);
    CHECK(head.last(2).kind == Kind::end);
}

TEST_CASE("What a dead rank has left on the disk is not rendered again") {
    Head head;
    head.start(2);
    head.ready(1);
    head.tell(1, Tell::ask);
    head.tell(1, Tell::ask);  // one sample done, the other under way
    head.on_disk = SampleRanges({0, 2});
    head.coordinator.tick(head.now + Coordinator::longest_silence + 1);
    REQUIRE(head.warnings.size() >= 1);
    CHECK(head.warnings[0].find("has not answered for") != std::string::npos);
    CHECK(head.coordinator.state(head.now).samples.text() == "0:2");
    head.ready(0);
    head.tell(0, Tell::ask);
    CHECK(head.last(0).ranks == std::vector<int>{0});
}

TEST_CASE("A rank of another picture is left out, and one that gives up too") {
    Head head;
    head.ready(1, "another");
    head.tell(1, Tell::ask);
    head.start(2);
    REQUIRE(head.warnings.size() == 1);
    CHECK(head.warnings[0].find("rank 1 on host") == 0);
    CHECK(head.last(1).code == -1);
    head.ready(2);
    head.tell(2, Tell::ask);
    CHECK(head.last(2).kind == Kind::render);
    head.tell(2, Tell::gave_up, WordWriter().put(std::string("no device")).take());
    CHECK(head.warnings.back().find("rank 2 on host (process 102): no device") == 0);
    head.ready(0);
    head.tell(0, Tell::ask);
    CHECK(head.last(0).block == SampleRange{0, 1});
    head.tell(0, Tell::gave_up, WordWriter().put(std::string("no device")).take());
    CHECK(head.last(0).kind == Kind::stop);  // nobody is left
    CHECK(head.last(1).kind == Kind::stop);
}

TEST_CASE("Of what ails all ranks, rank 0 alone speaks, and what ails one is named when rank 0 begins") {
    Head head;
    head.tell(1, Tell::gave_up, WordWriter().put(std::string("no device")).take());
    CHECK(head.warnings.empty());
    head.start(2);
    REQUIRE(head.warnings.size() == 1);
    CHECK(head.warnings[0] == "rank 1 on host (process 101): no device; the others render without it");
    // Such a rank has nothing to save.
    head.tell(0, Tell::interrupted, WordWriter().put(std::uint64_t{130}).take());
    head.tell(0, Tell::saved, WordWriter().put(std::uint64_t{0}).take());
    head.tell(2, Tell::saved, WordWriter().put(std::uint64_t{0}).take());
    CHECK(head.last(0).kind == Kind::finished);
}

TEST_CASE("A signal to one rank stops all, and rank 0 leaves when all have saved") {
    Head head;
    head.start(100);
    head.ready(0);
    head.tell(0, Tell::ask);
    CHECK(head.last(0).kind == Kind::render);
    head.tell(2, Tell::interrupted, WordWriter().put(std::uint64_t{143}).take());
    for (int rank = 0; rank < 3; ++rank) {
        const Order stop = head.last(rank);
        CHECK(stop.kind == Kind::stop);
        CHECK(stop.code == 143);
    }
    head.tell(0, Tell::saved, WordWriter().put(std::uint64_t{7}).take());
    head.tell(1, Tell::saved, WordWriter().put(std::uint64_t{0}).take());
    CHECK(head.last(0).code == -1);
    head.ended = 102;  // the last dies before it has saved
    head.coordinator.tick(head.now);
    CHECK(head.last(0).kind == Kind::finished);
    CHECK(head.coordinator.state(head.now).units_saved == 7);
}

}  // namespace diptych::core
