// How a render is cut into dispatches; needs no device.
#include "commands/slices.h"

#include <map>
#include <tuple>

#include "catch.h"

namespace diptych::core::tests {

TEST_CASE("Slices cover every sample of every pixel once, in order, within the budget") {
    const std::uint64_t budget = GENERATE(0U, 1U, 3U, 7U, 20U, 35U, 36U, 100U, 1000000U);
    const std::uint64_t limit = GENERATE(5U, 1000U);
    CAPTURE(budget, limit);
    SliceCursor cursor({2, 3, 7, 5}, 4, 6);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> next_sample;
    while (!cursor.done()) {
        const Slice slice = cursor.next(budget, limit);
        CHECK(slice.work() <= std::max<std::uint64_t>(budget, 1));
        CHECK(std::uint64_t{slice.region.width} * slice.region.height <= limit);
        for (std::uint32_t y = slice.region.y; y < slice.region.y + slice.region.height; ++y) {
            for (std::uint32_t x = slice.region.x; x < slice.region.x + slice.region.width; ++x) {
                const auto [entry, fresh] = next_sample.try_emplace({x, y}, 4U);
                REQUIRE(entry->second == slice.first_sample);
                entry->second += slice.sample_count;
            }
        }
    }
    CHECK(next_sample.size() == 35);
    CHECK(next_sample.begin()->first == std::pair(2U, 3U));
    CHECK(next_sample.rbegin()->first == std::pair(8U, 7U));
    for (const auto& [pixel, sample] : next_sample) {
        CHECK(sample == 10);
    }
}

TEST_CASE("A slice takes as many whole samples as the budget has room for, else as many whole rows") {
    const auto slices = [](std::uint64_t budget, std::uint64_t limit) {
        SliceCursor cursor({2, 3, 7, 5}, 4, 6);
        int count = 0;
        while (!cursor.done()) {
            cursor.next(budget, limit);
            ++count;
        }
        return count;
    };
    CHECK(slices(6 * 35, 1000) == 1);
    CHECK(slices(100, 1000) == 3);  // of two samples each
    CHECK(slices(35, 1000) == 6);
    CHECK(slices(34, 1000) == 6 * 2);  // four rows and one
    CHECK(slices(1000, 15) == 6 * 3);  // two rows, two and one
}

TEST_CASE("Nothing is left to slice where there are no samples or no pixels") {
    CHECK(SliceCursor({0, 0, 4, 4}, 0, 0).done());
    CHECK(SliceCursor({0, 0, 0, 4}, 0, 9).done());
}

TEST_CASE("The budget finds a device's speed within a few dispatches, and falls at once where work is dearer") {
    SpeedEstimate speed(0.06, 4096);
    CHECK(speed.budget() == 4096);
    const double cost = 1e-9;
    for (int i = 0; i < 5; ++i) {
        const std::uint64_t work = speed.budget();
        speed.learn(work, static_cast<double>(work) * cost);
    }
    CHECK(static_cast<double>(speed.budget()) * cost == Approx(0.06));
    const std::uint64_t budget = speed.budget();
    speed.learn(0, 1);
    CHECK(speed.budget() == budget);
    speed.learn(1000, 1000 * 1e-6);
    CHECK(static_cast<double>(speed.budget()) * 1e-6 == Approx(0.06).epsilon(1e-3));
}

TEST_CASE("The budget follows another aim at once, and grows towards it by steps") {
    SpeedEstimate speed(0.06, 4096);
    const double cost = 1e-6;
    for (int i = 0; i < 5; ++i) {
        speed.learn(speed.budget(), static_cast<double>(speed.budget()) * cost);
    }
    CHECK(speed.budget() == 60000);
    speed.aim(0.008);
    CHECK(speed.budget() == 8000);
    speed.aim(0.8);
    CHECK(speed.budget() == 64000);
    SpeedEstimate fresh(0.06, 4096);
    fresh.aim(0.002);
    CHECK(fresh.budget() == 4096);
    fresh.learn(4096, 4096 * cost);
    CHECK(fresh.budget() == 2000);
}

}  // namespace diptych::core::tests
