// Films are sums whose order does not matter.
#include "render/merge_films.h"

#include <cstring>
#include <random>

#include "catch.h"
#include "error.h"
#include "render/film_statistics.h"

namespace diptych::core {
namespace {

constexpr std::size_t pixels = 40;

Film empty_film() {
    Film film;
    film.width = static_cast<int>(pixels);
    film.height = 1;
    film.pixels.resize(pixels);
    film.moments.resize(pixels);
    film.first_hits.resize(pixels);
    return film;
}

/// Samples of all magnitudes that a float has: pixel i spans 2^(±3 i). Some are to be dropped.
void add_sample(Film& film, std::uint32_t sample) {
    for (std::size_t i = 0; i < pixels; ++i) {
        std::mt19937 random(sample * 7919U + static_cast<unsigned>(i));
        const auto value = [&] {
            const int exponent = static_cast<int>(random() % (6 * i + 1)) - 3 * static_cast<int>(i);
            return std::ldexp(static_cast<float>(random() >> 8U) * 0x1p-24F, exponent);
        };
        const shared::vec3 radiance(value(), value(), random() % 31 == 0 ? -1.0F : value());
        if (shared::film_add(film.pixels[i], radiance, random() >> (random() % 32))) {
            shared::film_add_moments(film.moments[i], radiance);
        }
        const auto signed_unit = [&] { return static_cast<float>(random() >> 8U) * 0x1p-23F - 1; };
        shared::film_add_first_hit(film.first_hits[i],
                                   {shared::vec3(0.5F * value()), {signed_unit(), signed_unit(), signed_unit()}, value()});
    }
}

Film film_of_samples(const std::vector<std::uint32_t>& samples) {
    Film film = empty_film();
    for (const std::uint32_t sample : samples) {
        add_sample(film, sample);
    }
    return film;
}

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

bool same(const Film& a, const Film& b) {
    return same_bytes(a.pixels, b.pixels) && same_bytes(a.moments, b.moments) && same_bytes(a.first_hits, b.first_hits);
}

}  // namespace

TEST_CASE("Any partition of the samples, merged in any order, has the bits of one film", "[render]") {
    constexpr std::uint32_t count = 96;
    std::vector<std::uint32_t> samples(count);
    std::iota(samples.begin(), samples.end(), 0U);
    const Film whole = film_of_samples(samples);
    std::mt19937 random(3);
    for (int trial = 0; trial < 30; ++trial) {
        std::shuffle(samples.begin(), samples.end(), random);
        const std::uint32_t parts = 1 + random() % 8;
        std::vector<std::vector<std::uint32_t>> divided(parts);
        for (const std::uint32_t sample : samples) {
            divided[random() % parts].push_back(sample);
        }
        Film merged = empty_film();
        for (const std::vector<std::uint32_t>& part : divided) {
            merge_films(film_of_samples(part), merged);
        }
        CAPTURE(trial);
        CHECK(same(merged, whole));
    }
}

TEST_CASE("Merged bins carry into their upper words", "[render]") {
    Film film = empty_film();
    for (int i = 0; i < 3; ++i) {
        shared::film_add(film.pixels[0], shared::vec3(1 - 0x1p-24F), 0xf0000000U);  // mantissas of ones
    }
    for (int doubling = 0; doubling < 30; ++doubling) {
        const Film half = film;
        merge_films(half, film);
    }
    const double n = 3.0 * (1U << 30U);
    CHECK(film.pixels[0].samples == 3U << 30U);
    CHECK(rounded(film.pixels[0].sum)[0] == n * (1 - 0x1p-24));
    CHECK(film_totals(film).rays == static_cast<std::uint64_t>(0xf0000000ULL * 3) << 30U);
}

TEST_CASE("Films of different sizes or layers are not merged", "[render]") {
    Film into = empty_film();
    Film from = empty_film();
    from.moments.clear();
    CHECK_THROWS_AS(merge_films(from, into), Error);
    from = empty_film();
    from.first_hits.clear();
    CHECK_THROWS_AS(merge_films(from, into), Error);
    from = empty_film();
    from.height = 2;
    CHECK_THROWS_AS(merge_films(from, into), Error);
}

}  // namespace diptych::core
