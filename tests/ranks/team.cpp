// Ranks as threads of one process: orders, films, and what happens when one of them fails.
#include "ranks/team.h"

#include <chrono>
#include <cstring>
#include <random>
#include <thread>

#include "catch.h"
#include "clock.h"
#include "memory_channel.h"
#include "ranks/film_exchange.h"
#include "render/merge_films.h"

namespace diptych::core::tests {
namespace {

constexpr int width = 300;
constexpr int height = 200;  // two pieces of a film

Film empty_film() {
    Film film;
    film.width = width;
    film.height = height;
    film.pixels.resize(std::size_t{width} * height);
    film.moments.resize(film.pixels.size());
    film.first_hits.resize(film.pixels.size());
    return film;
}

/// Samples of many magnitudes in every 50th pixel.
void add_sample(Film& film, std::uint64_t sample) {
    std::mt19937 random(static_cast<std::uint32_t>(sample) * 7919U);
    for (std::size_t i = 0; i < film.pixels.size(); i += 50) {
        const auto value = [&] { return std::ldexp(static_cast<float>(random() >> 8U), static_cast<int>(random() % 60) - 40); };
        const shared::vec3 radiance(value(), value(), value());
        shared::film_add(film.pixels[i], radiance, 3);
        shared::film_add_moments(film.moments[i], radiance);
        shared::film_add_first_hit(film.first_hits[i], {shared::vec3(0.25F), shared::vec3(0.5F), value()});
    }
}

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

struct Fault {
    int rank = -1;
    double delay = 0;          // seconds a sample
    int gives_up_after = -1;   // blocks
    bool gives_up_in_merge = false;
    int interrupted_after = -1;  // blocks
};

struct RankResult {
    int exit_code = -1;
    std::uint64_t samples = 0;  // rendered
    double last_end = 0;        // of a block
    std::shared_ptr<const Film> film;
};

/// What `render` does on each rank, with a film of made-up samples.
RankResult render_on(std::unique_ptr<RankChannel> channel, std::uint64_t samples, const Fault& fault,
                     std::vector<std::string>& warnings) {
    RankResult result;
    std::atomic<bool> interrupted = false;
    TeamHooks hooks;
    hooks.interrupted = [&] { return interrupted.load(); };
    hooks.interrupt_code = [] { return 130; };
    hooks.warn = [&](const std::string& line) { warnings.push_back(line); };
    hooks.note = [](const std::string&) {};
    Team team(std::move(channel), hooks);
    const bool faulty = team.place().rank == fault.rank;
    if (team.leads()) {
        Work work;
        work.wanted = SampleRanges({0, samples});
        work.limits.most_seconds = 0.2;
        work.picture = "p";
        team.start(std::move(work));
    }
    team.ready({"p", "d"});
    Film film = empty_film();
    int blocks = 0;
    bool gone = false;
    Order order = team.next();
    for (;;) {
        if (order.kind == Order::Kind::render) {
            for (std::uint64_t sample = order.block.first; sample < order.block.end; ++sample) {
                add_sample(film, sample);
                std::this_thread::sleep_for(std::chrono::duration<double>(faulty ? 0.002 + fault.delay : 0.002));
            }
            result.samples += order.block.end - order.block.first;
            result.last_end = now_seconds();
            ++blocks;
            interrupted = interrupted || (faulty && blocks == fault.interrupted_after);
            if (faulty && blocks == fault.gives_up_after) {
                team.tell_gave_up("tired");
                film = empty_film();
                gone = true;
            }
            order = team.next();
        } else if (order.kind == Order::Kind::merge) {
            if (faulty && fault.gives_up_in_merge && !gone) {
                team.tell_gave_up("tired");
                film = empty_film();
                gone = true;
                order = team.next();
                continue;
            }
            const auto sum = merge_films_of_ranks(team, order, std::make_shared<Film>(film));
            if (team.leads() && sum) {
                result.film = sum;
                order = team.merged(order.attempt);
            } else {
                order = team.next();
            }
        } else if (order.kind == Order::Kind::stop) {
            team.tell_saved(result.samples);
            if (team.leads()) {
                order = team.wait_for_saved();
            } else {
                order = team.wait_for_end();
            }
        } else {
            break;
        }
    }
    result.exit_code = order.code;
    if (team.leads()) {
        result.exit_code = order.kind == Order::Kind::finished ? order.code : -2;
        team.end(result.exit_code);
        team.leave({});
    } else {
        const Order end = team.wait_for_end();
        result.exit_code = end.code;
        team.leave(end);
    }
    return result;
}

std::vector<RankResult> render_on_all(int ranks, std::uint64_t samples, const Fault& fault,
                                      std::vector<std::string>& warnings) {
    const auto exchange = std::make_shared<MemoryExchange>(ranks);
    std::vector<RankResult> results(static_cast<std::size_t>(ranks));
    std::vector<std::vector<std::string>> said(static_cast<std::size_t>(ranks));
    std::vector<std::thread> threads;
    for (int rank = 0; rank < ranks; ++rank) {
        const auto r = static_cast<std::size_t>(rank);
        threads.emplace_back([&, rank, r] {
            results[r] = render_on(std::make_unique<MemoryChannel>(exchange, rank), samples, fault, said[r]);
        });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    warnings = said[0];
    return results;
}

void check_whole(const Film& film, std::uint64_t samples) {
    Film whole = empty_film();
    for (std::uint64_t sample = 0; sample < samples; ++sample) {
        add_sample(whole, sample);
    }
    CHECK(same_bytes(film.pixels, whole.pixels));
    CHECK(same_bytes(film.moments, whole.moments));
    CHECK(same_bytes(film.first_hits, whole.first_hits));
}

}  // namespace

TEST_CASE("Films of any number of ranks add up to the film of one") {
    const int ranks = GENERATE(1, 2, 3, 5, 8);
    CAPTURE(ranks);
    std::vector<std::string> warnings;
    const auto results = render_on_all(ranks, 120, {}, warnings);
    REQUIRE(results[0].film);
    check_whole(*results[0].film, 120);
    for (const RankResult& result : results) {
        CHECK(result.exit_code == 0);
        CHECK(result.samples > 0);
    }
    CHECK(warnings.empty());
}

TEST_CASE("A slow rank gets less, and holds the others up by a block at most", "[timed]") {
    std::vector<std::string> warnings;
    Fault fault;
    fault.rank = 2;
    fault.delay = 0.08;  // forty times as slow
    const auto results = render_on_all(4, 600, fault, warnings);
    REQUIRE(results[0].film);
    check_whole(*results[0].film, 600);
    CHECK(results[2].samples < 60);
    double first = HUGE_VAL, last = 0;
    for (const RankResult& result : results) {
        first = std::min(first, result.last_end);
        last = std::max(last, result.last_end);
    }
    CHECK(last - first < 0.3);  // it takes 0.08 s for a sample, and blocks of 0.2 s at most
}

TEST_CASE("What a rank had that gives up is rendered by the others") {
    Fault fault;
    fault.rank = GENERATE(0, 1, 2);
    SECTION("between blocks") { fault.gives_up_after = 3; }
    SECTION("while films are added up") { fault.gives_up_in_merge = true; }
    CAPTURE(fault.rank, fault.gives_up_after);
    std::vector<std::string> warnings;
    const auto results = render_on_all(3, 150, fault, warnings);
    REQUIRE(results[0].film);
    check_whole(*results[0].film, 150);
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].find("rank " + std::to_string(fault.rank) + " on here") == 0);
    CHECK(warnings[0].find("tired") != std::string::npos);
    std::uint64_t rendered = 0;
    for (const RankResult& result : results) {
        rendered += result.samples;
    }
    CHECK(rendered > 150);
}

TEST_CASE("A signal to any rank stops all, with its exit code") {
    Fault fault;
    fault.rank = GENERATE(0, 2);
    fault.interrupted_after = 2;
    std::vector<std::string> warnings;
    const auto results = render_on_all(3, 100000, fault, warnings);
    for (const RankResult& result : results) {
        CHECK(result.exit_code == 130);
        CHECK_FALSE(result.film);
        CHECK(result.samples < 100000);
    }
}

}  // namespace diptych::core::tests
