// Picking from alias tables, and the weights of multiple importance sampling.
#include "numbers/alias_table.h"

#include "catch.h"
#include "close.h"
#include "path/mis.h"

#include <cmath>

using namespace diptych::core::shared;
using diptych::core::tests::close;

namespace {

AliasEntry entry(float probability, uint alias) {
    AliasEntry e;
    e.probability = probability;
    e.alias = alias;
    return e;
}

}  // namespace

TEST_CASE("alias_pick keeps or takes the alias at all 32 bits") {
    CHECK(alias_pick(entry(1, 7), 3, 0xffffffffu) == 3);
    CHECK(alias_pick(entry(0, 7), 3, 0) == 7);
    CHECK(alias_pick(entry(0.5f, 7), 3, 0x7fffffffu) == 3);
    CHECK(alias_pick(entry(0.5f, 7), 3, 0x80000000u) == 7);
    CHECK(alias_pick(entry(0x1p-32f, 7), 3, 0) == 3);
    CHECK(alias_pick(entry(0x1p-32f, 7), 3, 1) == 7);
    CHECK(alias_pick(entry(1 - 0x1p-24f, 7), 3, 0xfffffeffu) == 3);
    CHECK(alias_pick(entry(1 - 0x1p-24f, 7), 3, 0xffffff00u) == 7);
}

TEST_CASE("alias_column spreads the words evenly and stays in range") {
    for (const uint count : {1u, 3u, 1000u, 1u << 25}) {
        CHECK(alias_column(0, count) == 0);
        CHECK(alias_column(0xffffffffu, count) == count - 1);
        CHECK(alias_column(0x80000000u, count) == count / 2);
    }
    uint counts[3] = {};
    for (uint i = 0; i < 3000; i++) {
        counts[alias_column(i * (0xffffffffu / 3000u), 3)]++;
    }
    for (const uint count : counts) {
        CHECK((count >= 999 && count <= 1001));
    }
}

TEST_CASE("mis_weight is the heuristic's, and the two weights add up") {
    CHECK(mis_weight(MIS_BALANCE, 1, 3) == 0.25f);
    CHECK(close(mis_weight(MIS_POWER, 1, 3), 0.1, 1e-6));
    CHECK(close(mis_weight(MIS_POWER, 3, 1), 0.9, 1e-6));
    for (float a = 1e-30f; a < 1e30f; a *= 7) {
        for (float b = 1e-30f; b < 1e30f; b *= 13) {
            for (const uint heuristic : {MIS_POWER, MIS_BALANCE}) {
                REQUIRE(std::abs(mis_weight(heuristic, a, b) + mis_weight(heuristic, b, a) - 1) < 1e-6f);
            }
        }
    }
}

TEST_CASE("mis_weight is defined at the extremes") {
    const float infinity = INFINITY;
    for (const uint heuristic : {MIS_POWER, MIS_BALANCE}) {
        CHECK(mis_weight(heuristic, 0, 0) == 0);
        CHECK(mis_weight(heuristic, 0, 1) == 0);
        CHECK(mis_weight(heuristic, 1, 0) == 1);
        CHECK(mis_weight(heuristic, infinity, 1) == 1);
        CHECK(mis_weight(heuristic, 1, infinity) < 1e-30f);
        CHECK(mis_weight(heuristic, infinity, infinity) == 0.5f);
        CHECK(mis_weight(heuristic, NAN, 1) == 0);
        CHECK(mis_weight(heuristic, 1, NAN) == 1);
        CHECK(mis_weight(heuristic, 1e38f, 1e38f) == 0.5f);
        CHECK(mis_weight(heuristic, 1e-38f, 1e-38f) == 0.5f);
    }
}
