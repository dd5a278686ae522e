// Who gets what, without any rank.
#include "ranks/ledger.h"

#include <cmath>
#include <queue>
#include <random>

#include "catch.h"

namespace diptych::core {
namespace {

/// Ranks that render at given speeds, by a clock that jumps from one end of a block to the next.
struct Simulation {
    std::vector<double> speeds;  // units a second
    std::vector<double> ended;   // when each rank found nothing more to do
    double longest_last_block = 0;
    double now = 0;

    void run(Ledger& ledger, const std::function<void(double)>& at_each_end = {}) {
        using End = std::pair<double, int>;
        std::priority_queue<End, std::vector<End>, std::greater<>> ends;
        ended.assign(speeds.size(), 0);
        std::vector<double> last(speeds.size());
        const auto deal = [&](int rank) {
            const auto r = static_cast<std::size_t>(rank);
            if (const auto block = ledger.deal(rank, now)) {
                last[r] = static_cast<double>(block->end - block->first) / speeds[r];
                ends.emplace(now + last[r], rank);
            } else {
                ended[r] = now;
            }
        };
        for (int rank = 0; rank < static_cast<int>(speeds.size()); ++rank) {
            deal(rank);
        }
        while (!ends.empty()) {
            const auto [end, rank] = ends.top();
            ends.pop();
            now = end;
            ledger.finish(rank, now);
            if (at_each_end) {
                at_each_end(now);
            }
            deal(rank);
        }
        longest_last_block = *std::max_element(last.begin(), last.end());
    }
};

}  // namespace

TEST_CASE("Ranks of any speed end together, and nobody waits longer than a block") {
    const std::vector<std::vector<double>> cases = {
        {100, 100}, {1000, 10, 10, 10}, {1, 50, 400}, {30, 30, 30, 30, 30, 30, 30, 0.7}};
    for (const std::vector<double>& speeds : cases) {
        CAPTURE(speeds);
        constexpr std::uint64_t units = 20000;
        Ledger ledger(SampleRanges({0, units}), static_cast<int>(speeds.size()));
        Simulation simulation{speeds, {}, 0, 0};
        simulation.run(ledger);
        CHECK(ledger.complete());
        CHECK(ledger.finished().text() == "0:20000");
        double total = 0;
        for (const double speed : speeds) {
            total += speed;
        }
        for (const double end : simulation.ended) {
            CHECK(simulation.now - end <= simulation.longest_last_block);
        }
        // What the last blocks cost: a block of the least length, or one unit of the slowest rank.
        const double slowest = 1 / *std::min_element(speeds.begin(), speeds.end());
        CHECK(simulation.now <= units / total * 1.01 + 0.1 + slowest);
    }
}

TEST_CASE("A rank that becomes slow holds the others up by a block at most") {
    Ledger ledger(SampleRanges({0, 60000}), 4);
    Simulation simulation{{500, 500, 500, 500}, {}, 0, 0};
    bool slow = false;
    simulation.run(ledger, [&](double now) {
        if (now > 3) {
            slow = true;
            simulation.speeds[2] = 50;  // a tenth
        }
    });
    CHECK(slow);
    CHECK(ledger.complete());
    CHECK(simulation.now - *std::min_element(simulation.ended.begin(), simulation.ended.end()) <=
          simulation.longest_last_block);
    // The block that it had takes up to ten seconds. Those after it are as short as it is slow.
    CHECK(simulation.longest_last_block < 0.2);
    CHECK(simulation.now < 3 + (60000 - 3 * 2000) / 1550.0 + 0.5);
}

TEST_CASE("Every unit is finished once, whichever ranks are lost on the way") {
    std::mt19937 random(7);
    for (int run = 0; run < 200; ++run) {
        CAPTURE(run);
        SampleRanges wanted;
        for (std::uint64_t at = random() % 5; at < 400; at += 1 + random() % 40) {
            const std::uint64_t end = at + 1 + random() % 60;
            wanted.add({at, end});
            at = end;
        }
        constexpr int ranks = 4;
        Ledger ledger(wanted, ranks);
        SampleRanges safe;  // of ranks that were lost, on the disk
        std::vector<SampleRange> blocks(ranks);
        double now = 0;
        while (!ledger.complete()) {
            now += 0.01;
            const int rank = static_cast<int>(random() % ranks);
            auto& block = blocks[static_cast<std::size_t>(rank)];
            if (ledger.has_block(rank)) {
                if (random() % 10 > 0) {
                    ledger.finish(rank, now);
                    continue;
                }
                // What was on the disk: some of what it finished, and perhaps the block that it could not report.
                SampleRanges kept;
                for (const SampleRange& range : ledger.finished_by(rank).ranges()) {
                    if (random() % 2 == 0) {
                        kept.add(range);
                    }
                }
                if (random() % 2 == 0) {
                    kept.add(block);
                }
                REQUIRE_FALSE(safe.shared_with(kept));
                safe.add(kept);
                ledger.drop(rank, kept);
            } else if (const auto dealt = ledger.deal(rank, now)) {
                block = *dealt;
            }
        }
        CHECK(ledger.finished() == wanted);
        // The films of the ranks and the files hold each unit once.
        std::uint64_t count = safe.count();
        for (int rank = 0; rank < ranks; ++rank) {
            CHECK_FALSE(safe.shared_with(ledger.finished_by(rank)));
            count += ledger.finished_by(rank).count();
        }
        CHECK(count == wanted.count());
    }
}

TEST_CASE("A limit of time ends the blocks in time, and leaves no gap") {
    Ledger ledger(SampleRanges({100, 0xffffffffU}), 3, {.seconds = 10});
    Simulation simulation{{90, 41, 7}, {}, 0, 0};
    simulation.run(ledger);
    ledger.deal(0, 10);  // which finds that time is up
    CHECK(ledger.complete());
    REQUIRE(ledger.finished().ranges().size() == 1);
    CHECK(ledger.finished().ranges()[0].first == 100);
    CHECK(std::abs(static_cast<double>(ledger.finished().count()) - 1380) < 0.02 * 1380);
    CHECK(simulation.now <= 10.2);
    // What a rank loses after the end is rendered all the same.
    const std::uint64_t lost = ledger.finished_by(2).count();
    ledger.drop(2);
    CHECK(ledger.left() == lost);
    CHECK(ledger.deal(0, 11));
}

}  // namespace diptych::core
