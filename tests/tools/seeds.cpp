// Seeds that are derived from one another are distinct by construction (common/render/seeds.h).
#include "render/seeds.h"

#include "catch.h"

#include <algorithm>
#include <vector>

#include "error.h"

using namespace diptych::core;

namespace {

void add(std::vector<std::uint32_t>& seeds, const SeedPlan& plan, std::uint32_t sides, std::uint32_t runs,
         std::uint64_t first_part, std::uint64_t parts) {
    for (std::uint64_t part = first_part; part < first_part + parts; ++part) {
        for (std::uint32_t side = 0; side < sides; ++side) {
            for (std::uint32_t run = 0; run < runs; ++run) {
                seeds.push_back(plan.seed(side, run, part));
            }
        }
    }
}

}  // namespace

TEST_CASE("Derived seeds are distinct, over sides, stages, chains, frames, references, runs and panels") {
    constexpr std::uint32_t sides = 20, most_runs = 4096, frames = 1000;
    for (const std::uint32_t given : {0U, 1U, 4097U, 0x0fff0000U, 0x10000000U, 0xffffffffU}) {
        INFO("--seed " << given);
        std::vector<std::uint32_t> seeds;
        for (const SeedPurpose purpose : {SeedPurpose::verify, SeedPurpose::verify_again}) {
            const SeedPlan plan(given, purpose, sides, most_runs);
            add(seeds, plan, sides, most_runs, 0, 4);
            add(seeds, plan, sides, most_runs, plan.parts() - 2, 2);  // the last there are
        }
        add(seeds, SeedPlan(given, SeedPurpose::converge, sides, most_runs), sides, most_runs, 0, 1);
        add(seeds, SeedPlan(given, SeedPurpose::converge_picture, sides, 1), sides, 1, 0, 1);
        add(seeds, SeedPlan(given, SeedPurpose::converge_reference, 1, 16), 1, 16, 0, 1);
        add(seeds, SeedPlan(given, SeedPurpose::test, 1, most_runs), 1, most_runs, 0, 1);
        for (std::uint32_t place = 0; given < seeds_of_purpose - frames && place < frames; ++place) {
            seeds.push_back(neighbor_seed(given, place));
        }
        std::sort(seeds.begin(), seeds.end());
        CHECK(std::adjacent_find(seeds.begin(), seeds.end()) == seeds.end());
    }
}

TEST_CASE("Commands of different seeds share none") {
    constexpr std::uint32_t commands = 1U << 10U, renders = 1U << 16U;
    std::vector<std::uint32_t> firsts;
    for (std::uint32_t given = 0; given < commands; ++given) {
        firsts.push_back(SeedPlan(given, SeedPurpose::verify, 1, renders).seed(0, 0) % seeds_of_purpose);
    }
    std::sort(firsts.begin(), firsts.end());
    std::uint64_t closest = firsts.front() + seeds_of_purpose - firsts.back();
    for (std::size_t i = 1; i < firsts.size(); ++i) {
        closest = std::min<std::uint64_t>(closest, firsts[i] - firsts[i - 1]);
    }
    CHECK(closest >= renders);
}

TEST_CASE("A plan refuses what it has no seeds for") {
    CHECK_THROWS_AS(SeedPlan(1, SeedPurpose::verify, 1U << 16U, 1U << 13U), Error);
    const SeedPlan plan(1, SeedPurpose::verify, 3, 1000);
    CHECK(plan.parts() == seeds_of_purpose / 3000);
    CHECK_NOTHROW(plan.seed(2, 999, plan.parts() - 1));
    CHECK_THROWS_AS(plan.seed(0, 0, plan.parts()), Error);
}
