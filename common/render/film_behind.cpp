#include "render/film_behind.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <exception>
#include <fstream>
#include <functional>
#include <future>
#include <mutex>
#include <stdexcept>
#include <vector>

#include "digest.h"
#include "image/size_claim.h"
#include "render/film_blocks.h"
#include "render/film_words.h"
#include "threads.h"

namespace diptych::core {

namespace {

constexpr std::array<char, 8> film_magic = {'f', 'i', 'l', 'm', 's', 'u', 'm', '1'};
constexpr std::size_t group_pixels = 64 * block_pixels;

struct Group {
    std::uint64_t bytes = 0;
    std::uint64_t digest = 0;
};

struct Footer {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t moments = 0;  // 1 or 0
    std::uint32_t first_hits = 0;
    std::uint64_t digest = 0;  // of the table and of what stands above
    std::array<char, 8> magic = film_magic;
};
static_assert(sizeof(Group) == 16 && offsetof(Footer, digest) == 16 && sizeof(Footer) == 32);

std::size_t groups_of(std::size_t pixels) {
    return (pixels + group_pixels - 1) / group_pixels;
}

/// Every group begins at a page, so that it can be written past the page cache.
std::size_t whole_pages(std::size_t bytes) {
    return (bytes + sink_page - 1) / sink_page * sink_page;
}

template <class T>
std::span<const unsigned char> bytes_of_all(const T* first, std::size_t count) {
    return {reinterpret_cast<const unsigned char*>(first), count * sizeof(T)};
}

std::uint64_t digest_of_table(const std::vector<Group>& groups, const Footer& footer) {
    return digest_of(bytes_of_all(&footer, 1).first(offsetof(Footer, digest)),
                     digest_of(bytes_of_all(groups.data(), groups.size())));
}

/// Calls `work` with each number below `count`, on all cores. Throws the first of what it threw.
void for_each_on_all_cores(std::size_t count, const std::function<void(std::size_t)>& work) {
    std::mutex mutex;
    std::exception_ptr failure;
    in_parts(count, [&](std::size_t begin, std::size_t end) {
        try {
            for (std::size_t i = begin; i < end; ++i) {
                work(i);
            }
        } catch (...) {
            const std::lock_guard lock(mutex);
            failure = failure ? failure : std::current_exception();
        }
    });
    if (failure) {
        std::rethrow_exception(failure);
    }
}

[[noreturn]] void fail_damaged() {
    throw std::runtime_error("the sums of its samples are damaged");
}

template <class T>
void read_at(std::ifstream& file, std::uint64_t place, T* to, std::size_t count) {
    file.seekg(static_cast<std::streamoff>(place));
    if (!file.read(reinterpret_cast<char*>(to), static_cast<std::streamsize>(count * sizeof(T)))) {
        fail_damaged();
    }
}

/// An empty film as the footer has it. Before it is allocated, its size is held against the bytes of the file and
/// against the budget.
Film film_of(const Footer& footer, std::uint64_t file_bytes, MemoryBudget& budget) {
    const std::string problem = size_claim_problem(footer.width, footer.height, 1, file_bytes);
    if (!problem.empty()) {
        throw std::runtime_error(problem);
    }
    const std::size_t pixels = std::size_t{footer.width} * footer.height;
    Film film;
    film.width = static_cast<int>(footer.width);
    film.height = static_cast<int>(footer.height);
    if (least_packed_bytes(film, pixels) + groups_of(pixels) * sizeof(Group) + sizeof footer > file_bytes) {
        fail_damaged();
    }
    budget.ask(film_bytes(pixels, footer.moments != 0, footer.first_hits != 0));
    film.pixels.resize(pixels);
    film.moments.resize(footer.moments != 0 ? pixels : 0);
    film.first_hits.resize(footer.first_hits != 0 ? pixels : 0);
    return film;
}

}  // namespace

void write_film_behind(const Film& film, TemporaryFile& file) {
    const std::size_t pixels = film.pixels.size();
    std::vector<Group> groups(groups_of(pixels));
    // A round of groups is packed, then written, because only then it is known where each goes. The disk writes one round
    // while the next is packed.
    const std::size_t most = whole_pages(most_packed_bytes(film, group_pixels));
    std::array<std::vector<Pages>, 2> rounds;
    for (std::vector<Pages>& round : rounds) {
        round.resize(std::min<std::size_t>(4 * machine_threads(), groups.size()));
        for (Pages& pages : round) {
            pages = make_pages(most);
        }
    }
    std::vector<std::uint64_t> places(groups.size());
    std::uint64_t end = whole_pages(file.size());
    std::future<void> writing;  // where no thread can be started, `get` does the work
    for (std::size_t first = 0, turn = 0; first < groups.size(); first += rounds[turn].size(), turn = 1 - turn) {
        const std::vector<Pages>& round = rounds[turn];
        const std::size_t count = std::min(round.size(), groups.size() - first);
        for_each_on_all_cores(count, [&](std::size_t i) {
            const std::size_t begin = (first + i) * group_pixels;
            const std::span<unsigned char> to(round[i].get(), most);
            const std::size_t bytes = pack_pixels(film, begin, std::min(group_pixels, pixels - begin), to);
            std::fill_n(&to[bytes], whole_pages(bytes) - bytes, static_cast<unsigned char>(0));
            groups[first + i] = {bytes, digest_of_many(to.first(bytes))};
        });
        for (std::size_t i = first; i < first + count; ++i) {
            places[i] = end;
            end += whole_pages(groups[i].bytes);
        }
        if (writing.valid()) {
            writing.get();
        }
        writing = std::async([&file, &groups, &places, &round, first, count] {
            for_each_on_all_cores(count, [&](std::size_t i) {
                file.write_at(places[first + i], {round[i].get(), whole_pages(groups[first + i].bytes)});
            });
        });
    }
    if (writing.valid()) {
        writing.get();
    }
    Footer footer;
    footer.width = static_cast<std::uint32_t>(film.width);
    footer.height = static_cast<std::uint32_t>(film.height);
    footer.moments = film.moments.empty() ? 0 : 1;
    footer.first_hits = film.first_hits.empty() ? 0 : 1;
    const std::span<const unsigned char> table = bytes_of_all(groups.data(), groups.size());
    footer.digest = digest_of_table(groups, footer);
    file.write_at(end, table);
    file.write_at(end + table.size(), bytes_of_all(&footer, 1));
}

Film read_film_behind(const std::filesystem::path& path, MemoryBudget& budget) {
    std::ifstream file(path, std::ios::binary);
    const std::uint64_t size = std::filesystem::file_size(path);
    Footer footer;
    if (size > sizeof footer) {
        read_at(file, size - sizeof footer, &footer, 1);
    }
    if (size <= sizeof footer || footer.magic != film_magic) {
        throw std::runtime_error("the sums of its samples are gone from its end: it was cut short, or written anew by "
                                 "another program");
    }
    Film film = film_of(footer, size, budget);
    const std::size_t pixels = film.pixels.size();
    std::vector<Group> groups(groups_of(pixels));
    const std::uint64_t table = size - sizeof footer - groups.size() * sizeof(Group);
    read_at(file, table, groups.data(), groups.size());
    if (digest_of_table(groups, footer) != footer.digest) {
        fail_damaged();
    }
    std::vector<std::uint64_t> places(groups.size());
    std::uint64_t end = table;
    for (std::size_t i = groups.size(); i-- > 0;) {
        if (groups[i].bytes > end || whole_pages(groups[i].bytes) > end) {
            fail_damaged();
        }
        places[i] = end -= whole_pages(groups[i].bytes);
    }
    for_each_on_all_cores(groups.size(), [&](std::size_t i) {
        thread_local std::vector<unsigned char> bytes;
        bytes.resize(groups[i].bytes);
        std::ifstream own(path, std::ios::binary);
        read_at(own, places[i], bytes.data(), bytes.size());
        if (digest_of_many(bytes) != groups[i].digest) {
            fail_damaged();
        }
        const std::size_t begin = i * group_pixels;
        unpack_pixels(bytes, begin, std::min(group_pixels, pixels - begin), film);
    });
    check_bases(film);
    return film;
}

}  // namespace diptych::core
