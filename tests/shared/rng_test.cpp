// Hashes: known values, uniformity bit by bit, and no correlation between neighbouring counters.
#include "numbers/rng.h"

#include "catch.h"
#include "stats/chi_square.h"

#include <set>

using namespace diptych::core::shared;
using diptych::core::deviate_limit;
using diptych::core::uniform_deviate;

TEST_CASE("pcg4d and hash_word give the words of the published definitions") {
    // Computed from the papers' definitions with integers of unlimited size.
    CHECK(pcg4d(uvec4(1, 2, 3, 4)) == uvec4(0x3622cd16u, 0xf11471d8u, 0xe1109b3fu, 0x02b94c2fu));
    CHECK(pcg4d(uvec4(0, 0, 0, 0)) == uvec4(0x0f02f829u, 0x2d568769u, 0x32b0c43bu, 0xd32548eau));
    CHECK(hash_word(1) == 0x688990c0u);
    CHECK(hash_word(12345) == 0x912efcf7u);
}

TEST_CASE("unit_float covers 0 to 1 and never reaches 1") {
    CHECK(unit_float(0) == 0);
    CHECK(unit_float(0xffu) == 0);
    CHECK(unit_float(0x100u) == 0x1p-24f);
    CHECK(unit_float(0xffffffffu) == 1 - 0x1p-24f);
}

TEST_CASE("pcg4d's words are uniform, and independent of the neighbouring counter's") {
    for (int counter = 0; counter < 4; counter++) {
        for (int word = 0; word < 4; word++) {
            std::vector<double> pairs(64 * 64);
            std::vector<double> low_pairs(64 * 64);
            uint previous = 0;
            for (uint i = 0; i < 400000; i++) {
                uvec4 v(3, 5, 7, 11);
                v[counter] = i;
                const uint bits = pcg4d(v)[word];
                pairs[(previous >> 26) * 64 + (bits >> 26)] += 1;
                low_pairs[((previous >> 8) & 63u) * 64 + ((bits >> 8) & 63u)] += 1;
                previous = bits;
            }
            CAPTURE(counter, word);
            CHECK(std::abs(uniform_deviate(pairs)) < deviate_limit);
            CHECK(std::abs(uniform_deviate(low_pairs)) < deviate_limit);
        }
    }
}

TEST_CASE("hash_combine tells order and pairs apart") {
    CHECK(hash_combine(0, 0) == hash_word(hash_word(0x9e3779b9U)));  // a pair of zeros is no fixed point
    CHECK(hash_combine(3, 5) == hash_word(hash_word(3 + 0x9e3779b9U) + 5));
    CHECK(hash_combine(1, 2) != hash_combine(2, 1));
    std::set<uint> seen;
    for (uint a = 0; a < 300; a++) {
        for (uint b = 0; b < 300; b++) {
            seen.insert(hash_combine(a, b));
        }
    }
    // 90 000 words out of 2^32: 0.94 collisions on average.
    CHECK(seen.size() >= 90000 - 8);
}
