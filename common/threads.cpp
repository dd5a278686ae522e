#include "threads.h"

#include <algorithm>
#include <latch>
#include <system_error>
#include <thread>
#include <vector>

#include "error.h"

namespace diptych::core {

unsigned machine_threads() {
    return std::max(1U, std::thread::hardware_concurrency());
}

void in_parts(std::size_t count, const std::function<void(std::size_t begin, std::size_t end)>& work) {
    const std::size_t parts = machine_threads();
    const auto begin_of = [&](std::size_t part) { return count * part / parts; };
    std::size_t part = 0;
    std::vector<std::jthread> threads;
    try {
        for (; part + 1 < parts; ++part) {
            threads.emplace_back(work, begin_of(part), begin_of(part + 1));
        }
    } catch (const std::system_error&) {  // this thread does what is left
    }
    work(begin_of(part), count);
}

void require_threads(unsigned count) {
    std::latch all_started(1);
    std::vector<std::jthread> threads;
    bool short_of_threads = false;
    try {
        for (unsigned i = 0; i < count; ++i) {
            threads.emplace_back([&] { all_started.wait(); });
        }
    } catch (const std::system_error&) {
        short_of_threads = true;
    }
    all_started.count_down();
    if (short_of_threads) {
        throw Error("only " + std::to_string(threads.size()) + " of " + std::to_string(count) +
                    " threads can be started: the limit of processes of this user or container is reached");
    }
}

}  // namespace diptych::core
