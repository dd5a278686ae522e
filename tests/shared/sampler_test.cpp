// The three samplers: uniform, pure, and stratified as each promises.
#include "numbers/sampler.h"

#include "catch.h"
#include "stats/chi_square.h"

#include <cmath>
#include <set>

using namespace diptych::core::shared;
using diptych::core::deviate_limit;
using diptych::core::uniform_deviate;

namespace {

Sampler sampler_of(uint kind, uvec2 pixel, uint index, uint seed, uint count) {
    return make_sampler(pixel, index, seed, kind, count);
}

const uint kinds[] = {SAMPLER_INDEPENDENT, SAMPLER_HAMMERSLEY, SAMPLER_SOBOL};

/// Chi-square over 32 x 32 cells of pairs that `pair` makes from a running number.
template <typename Pair>
double pair_deviate(Pair pair) {
    std::vector<double> cells(32 * 32);
    for (uint i = 0; i < 200000; i++) {
        const vec2 p = pair(i);
        cells[std::size_t(p.x * 32) * 32 + std::size_t(p.y * 32)] += 1;
    }
    return uniform_deviate(cells);
}

}  // namespace

TEST_CASE("Every sampler is a pure function into 0 to 1, without 1") {
    for (const uint kind : kinds) {
        for (uint i = 0; i < 20000; i++) {
            const Sampler s = sampler_of(kind, uvec2(i % 61, i % 17), i % 64, i / 1000, 64);
            const uint dimension = 2 * (i % 70);
            const vec2 u = sample_2d(s, dimension);
            REQUIRE((u.x >= 0 && u.x < 1 && u.y >= 0 && u.y < 1));
            REQUIRE(u == sample_2d(s, dimension));
            REQUIRE(u.x == sample_1d(s, dimension));
            REQUIRE(unit_float(sample_bits_2d(s, dimension).y) == u.y);
        }
    }
}

TEST_CASE("Every sampler is uniform over pixels and over seeds, sample by sample") {
    for (const uint kind : kinds) {
        for (const uint dimension : {DIMENSION_FILM, DIMENSION_LENS, DIMENSION_VERTEX + DIMENSION_BSDF_DIRECTION}) {
            CAPTURE(kind, dimension);
            CHECK(std::abs(pair_deviate([&](uint i) {
                      return sample_2d(sampler_of(kind, uvec2(i % 640, i / 640), 5, 1, 16), dimension);
                  })) < deviate_limit);
            CHECK(std::abs(pair_deviate([&](uint i) {
                      return sample_2d(sampler_of(kind, uvec2(7, 9), 15, i, 16), dimension);
                  })) < deviate_limit);
        }
    }
}

TEST_CASE("Dimensions, neighbouring pixels, samples and seeds are uncorrelated") {
    for (const uint kind : kinds) {
        CAPTURE(kind);
        const auto first = [&](uvec2 pixel, uint index, uint seed, uint dimension) {
            return sample_1d(sampler_of(kind, pixel, index, seed, 16), dimension);
        };
        CHECK(std::abs(pair_deviate([&](uint i) {
                  const uvec2 pixel(i % 640, i / 640);
                  return vec2(first(pixel, 3, 1, DIMENSION_FILM), first(pixel, 3, 1, DIMENSION_LENS));
              })) < deviate_limit);
        CHECK(std::abs(pair_deviate([&](uint i) {
                  const uvec2 pixel(i % 640, i / 640);
                  return vec2(first(pixel, 3, 1, DIMENSION_VERTEX),
                              first(pixel, 3, 1, DIMENSION_VERTEX + DIMENSIONS_PER_VERTEX));
              })) < deviate_limit);
        CHECK(std::abs(pair_deviate([&](uint i) {
                  return vec2(first(uvec2(i % 640, i / 640), 3, 1, DIMENSION_FILM),
                              first(uvec2(i % 640 + 1, i / 640), 3, 1, DIMENSION_FILM));
              })) < deviate_limit);
        CHECK(std::abs(pair_deviate([&](uint i) {
                  const uvec2 pixel(i % 640, i / 640);
                  return vec2(first(pixel, 3, 1, DIMENSION_FILM), first(pixel, 3, 2, DIMENSION_FILM));
              })) < deviate_limit);
    }
    CHECK(std::abs(pair_deviate([&](uint i) {
              return vec2(sample_1d(sampler_of(SAMPLER_INDEPENDENT, uvec2(1, 2), i, 1, 1), DIMENSION_FILM),
                          sample_1d(sampler_of(SAMPLER_INDEPENDENT, uvec2(1, 2), i + 1, 1, 1), DIMENSION_FILM));
          })) < deviate_limit);
}

TEST_CASE("Hammersley puts one sample into each of N intervals, rotation undone") {
    for (const uint count : {1u, 2u, 7u, 16u, 100u, 1024u, 65537u}) {
        const uvec2 pixel(12, 34);
        const uint seed = 99;
        for (const uint dimension : {DIMENSION_FILM, DIMENSION_LENS}) {
            const Sampler base = sampler_of(SAMPLER_HAMMERSLEY, pixel, 0, seed, count);
            const uvec3 words = dimension_words(base, dimension);
            std::set<uint> intervals;
            std::set<uint> inverses;
            for (uint i = 0; i < count; i++) {
                const uvec2 bits = sample_bits_2d(sampler_of(SAMPLER_HAMMERSLEY, pixel, i, seed, count), dimension);
                intervals.insert(multiply_high(bits.x - words.x, count));
                inverses.insert(bitfieldReverse(bits.y - words.y));
            }
            CAPTURE(count, dimension);
            CHECK(intervals.size() == count);
            CHECK(inverses.size() == count);
            CHECK(*inverses.rbegin() == count - 1);
        }
    }
}

TEST_CASE("Hammersley's lens is in no step with its film within a pixel") {
    // 8 x 8 cells, N = 1000 samples; both margins are stratified, so Pearson's statistic has 49 degrees of freedom.
    constexpr uint count = 1000, pixels = 400;
    for (int film = 0; film < 2; film++) {
        for (int lens = 0; lens < 2; lens++) {
            double statistic = 0;
            for (uint pixel = 0; pixel < pixels; pixel++) {
                double cells[64] = {};
                for (uint i = 0; i < count; i++) {
                    const Sampler s = sampler_of(SAMPLER_HAMMERSLEY, uvec2(pixel, 3), i, 1, count);
                    const float x = sample_2d(s, DIMENSION_FILM)[film], y = sample_2d(s, DIMENSION_LENS)[lens];
                    cells[std::size_t(x * 8) * 8 + std::size_t(y * 8)] += 1;
                }
                for (const double cell : cells) {
                    statistic += (cell - count / 64.0) * (cell - count / 64.0) / (count / 64.0);
                }
            }
            CAPTURE(film, lens);
            CHECK(statistic / (49 * pixels) > 0.9);
            CHECK(statistic / (49 * pixels) < 1.1);
        }
    }
}

TEST_CASE("Stratum centres are exact") {
    for (const uint n : {1u, 3u, 1000u, 65537u, 5000001u, HAMMERSLEY_MAX_COUNT}) {
        for (const uint i : {0u, n / 3, n / 2, n - 1}) {
            const std::uint64_t exact = ((2 * std::uint64_t{i} + 1) << 32U) / (2 * std::uint64_t{n});
            CHECK(stratum_center_bits(i, n) == exact);
        }
    }
}

TEST_CASE("permute_index permutes, and keys differ") {
    for (const uint n : {1u, 2u, 3u, 5u, 64u, 100u, 1000u}) {
        uint same = 0;
        for (uint key = 0; key < 20; key++) {
            std::set<uint> seen;
            for (uint i = 0; i < n; i++) {
                seen.insert(permute_index(i, n, hash_word(key + 1)));
                same += permute_index(i, n, hash_word(key + 1)) == i ? 1u : 0u;
            }
            CHECK(seen.size() == n);
            CHECK(*seen.rbegin() == n - 1);
        }
        if (n >= 64) {
            CHECK(same < 20 * n / 4);
        }
    }
}

TEST_CASE("Hammersley past its set and past the lens is independent") {
    for (const auto& [index, dimension] : {std::pair{64u, DIMENSION_FILM}, std::pair{3u, DIMENSION_VERTEX}}) {
        const Sampler hammersley = sampler_of(SAMPLER_HAMMERSLEY, uvec2(1, 2), index, 3, 64);
        const Sampler independent = sampler_of(SAMPLER_INDEPENDENT, uvec2(1, 2), index, 3, 64);
        CHECK(sample_bits_2d(hammersley, dimension) == sample_bits_2d(independent, dimension));
    }
}

TEST_CASE("Sobol' points are a (0, m, 2)-net for every power of two") {
    for (const uint dimension : {DIMENSION_FILM, DIMENSION_LENS, SOBOL_MAX_DIMENSION - 2}) {
        for (uint seed = 0; seed < 8; seed++) {
            for (uint m = 0; m <= 10; m++) {
                const uint count = 1u << m;
                for (uint first = 0; first < 3 * count; first += count) {
                    for (uint split = 0; split <= m; split++) {
                        std::set<uint> cells;
                        for (uint i = first; i < first + count; i++) {
                            const Sampler s = sampler_of(SAMPLER_SOBOL, uvec2(seed, 3), i, seed, count);
                            const uvec2 bits = sample_bits_2d(s, dimension);
                            const uint column = split == 0 ? 0 : bits.x >> (32 - split);
                            const uint row = split == m ? 0 : bits.y >> (32 - (m - split));
                            cells.insert((column << (m - split)) | row);
                        }
                        REQUIRE(cells.size() == count);
                    }
                }
            }
        }
    }
}

TEST_CASE("Sobol' from SOBOL_MAX_DIMENSION on is independent") {
    const Sampler sobol = sampler_of(SAMPLER_SOBOL, uvec2(1, 2), 7, 3, 64);
    const Sampler independent = sampler_of(SAMPLER_INDEPENDENT, uvec2(1, 2), 7, 3, 64);
    CHECK(sample_bits_2d(sobol, SOBOL_MAX_DIMENSION) == sample_bits_2d(independent, SOBOL_MAX_DIMENSION));
    CHECK(sample_bits_2d(sobol, DIMENSION_VERTEX) != sample_bits_2d(independent, DIMENSION_VERTEX));
}

TEST_CASE("Four pairs of dimensions are drawn at once as they are one by one") {
    for (const uint kind : kinds) {
        for (const uint dimension : {DIMENSION_FILM, DIMENSION_VERTEX, SOBOL_MAX_DIMENSION - 8, SOBOL_MAX_DIMENSION - 4}) {
            CAPTURE(kind, dimension);
            const Sampler s = sampler_of(kind, uvec2(5, 6), 9, 2, 64);
            const FourPairs pairs = sample_bits_four_pairs(s, dimension);
            for (int i = 0; i < 4; i++) {
                const uvec2 one = sample_bits_2d(s, dimension + 2 * uint(i));
                CHECK(pairs.first[i] == one.x);
                CHECK(pairs.second[i] == one.y);
            }
        }
    }
}

// A picture's metadata let anyone repeat it, so other words would be another renderer. No formula says which words are right.
TEST_CASE("Samplers give the words that they have always given") {
    struct Word {
        uint kind, dimension, index, x, y;
    };
    const Word words[] = {
        {SAMPLER_INDEPENDENT, DIMENSION_FILM, 0u, 0x6f9e35cfu, 0x49011741u},
        {SAMPLER_INDEPENDENT, DIMENSION_FILM, 5u, 0xef123d3eu, 0x3ca2185au},
        {SAMPLER_INDEPENDENT, DIMENSION_FILM, 13u, 0xce72c15au, 0x3a24a47du},
        {SAMPLER_INDEPENDENT, DIMENSION_LENS, 0u, 0xb09c4bb9u, 0x2698f3c2u},
        {SAMPLER_INDEPENDENT, DIMENSION_LENS, 5u, 0x60643105u, 0x0a92ed57u},
        {SAMPLER_INDEPENDENT, DIMENSION_LENS, 13u, 0xc35a0090u, 0x064d6cd0u},
        {SAMPLER_INDEPENDENT, DIMENSION_VERTEX, 0u, 0x0883cc70u, 0x53970ca7u},
        {SAMPLER_INDEPENDENT, DIMENSION_VERTEX, 5u, 0x870d8227u, 0x1e0d7208u},
        {SAMPLER_INDEPENDENT, DIMENSION_VERTEX, 13u, 0x6c8fbc90u, 0xbf3ec0fcu},
        {SAMPLER_HAMMERSLEY, DIMENSION_FILM, 0u, 0xf85efd14u, 0x93091015u},
        {SAMPLER_HAMMERSLEY, DIMENSION_FILM, 5u, 0x485efd14u, 0x33091015u},
        {SAMPLER_HAMMERSLEY, DIMENSION_FILM, 13u, 0xc85efd14u, 0x43091015u},
        {SAMPLER_HAMMERSLEY, DIMENSION_LENS, 0u, 0x6c1616d1u, 0xf09fd665u},
        {SAMPLER_HAMMERSLEY, DIMENSION_LENS, 5u, 0x2c1616d1u, 0xd09fd665u},
        {SAMPLER_HAMMERSLEY, DIMENSION_LENS, 13u, 0xcc1616d1u, 0x009fd665u},
        {SAMPLER_HAMMERSLEY, DIMENSION_VERTEX, 0u, 0x0883cc70u, 0x53970ca7u},
        {SAMPLER_HAMMERSLEY, DIMENSION_VERTEX, 5u, 0x870d8227u, 0x1e0d7208u},
        {SAMPLER_HAMMERSLEY, DIMENSION_VERTEX, 13u, 0x6c8fbc90u, 0xbf3ec0fcu},
        {SAMPLER_SOBOL, DIMENSION_FILM, 0u, 0x5b1cf260u, 0xf2d82d5fu},
        {SAMPLER_SOBOL, DIMENSION_FILM, 5u, 0xe9e12b12u, 0x52bf10ebu},
        {SAMPLER_SOBOL, DIMENSION_FILM, 13u, 0xc003fc33u, 0x34458794u},
        {SAMPLER_SOBOL, DIMENSION_LENS, 0u, 0x4bfc499fu, 0x689dc0f1u},
        {SAMPLER_SOBOL, DIMENSION_LENS, 5u, 0xddffc865u, 0x5911ccffu},
        {SAMPLER_SOBOL, DIMENSION_LENS, 13u, 0xe6a84b71u, 0x0ed7a580u},
        {SAMPLER_SOBOL, DIMENSION_VERTEX, 0u, 0x3967c05du, 0xca35d336u},
        {SAMPLER_SOBOL, DIMENSION_VERTEX, 5u, 0xf77cf47cu, 0xe0ed9503u},
        {SAMPLER_SOBOL, DIMENSION_VERTEX, 13u, 0xabaf308bu, 0x1df06f1eu},
    };
    for (const Word& w : words) {
        CAPTURE(w.kind, w.dimension, w.index);
        CHECK(sample_bits_2d(sampler_of(w.kind, uvec2(12, 34), w.index, 99, 16), w.dimension) == uvec2(w.x, w.y));
    }
}

TEST_CASE("Estimates over seeds are unbiased, and stratified ones vary less") {
    // f(x, y) = [x^2 + y^2 < 1], mean pi/4.
    double variance[3] = {};
    for (const uint kind : kinds) {
        double sum = 0, squares = 0;
        constexpr uint seeds = 4000, count = 16;
        for (uint seed = 0; seed < seeds; seed++) {
            double hits = 0;
            for (uint i = 0; i < count; i++) {
                const vec2 u = sample_2d(sampler_of(kind, uvec2(5, 5), i, seed, count), DIMENSION_LENS);
                hits += u.x * u.x + u.y * u.y < 1 ? 1.0 / count : 0.0;
            }
            sum += hits;
            squares += hits * hits;
        }
        const double mean = sum / seeds;
        variance[kind] = squares / seeds - mean * mean;
        CAPTURE(kind);
        CHECK(std::abs(mean - 0.785398163397448) < 4.5 * std::sqrt(variance[kind] / seeds));
    }
    CHECK(variance[SAMPLER_HAMMERSLEY] < 0.5 * variance[SAMPLER_INDEPENDENT]);
    CHECK(variance[SAMPLER_SOBOL] < 0.5 * variance[SAMPLER_INDEPENDENT]);
}
