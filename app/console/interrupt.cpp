#include "console/interrupt.h"

#include <cerrno>
#include <cstdint>
#include <ctime>
#include <iterator>
#include <string_view>

#include <unistd.h>

#include "console/exit_codes.h"

namespace diptych::core::app {

namespace {

constexpr int heeded[] = {SIGINT, SIGTERM, SIGHUP, SIGXCPU};
constexpr std::int64_t same_wish_nanoseconds = 200'000'000;

std::atomic<bool> guarded = false;
std::atomic<bool> interrupt_requested = false;
std::atomic<int> first_signal = 0;
std::atomic<std::int64_t> first_at = 0;
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<std::int64_t>::is_always_lock_free,
              "a signal handler may touch nothing else");

std::int64_t nanoseconds() {
    timespec now = {};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

[[noreturn]] void end_at_once(int signal, std::string_view line) {
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, line.data(), line.size());
    ::_exit(128 + signal);
}

void on_signal(int signal) {
    if (!guarded) {
        end_at_once(signal, "diptych: interrupted\n");
    }
    int none = 0;
    if (first_signal.compare_exchange_strong(none, signal)) {
        first_at = nanoseconds();
        interrupt_requested = true;
    } else if (signal != SIGXCPU && first_at != 0 && nanoseconds() - first_at > same_wish_nanoseconds) {
        end_at_once(signal, "diptych: interrupted again: ended at once\n");
    }
}

/// Writes what the signals did before to `before`, unless it is null.
void heed_signals(struct sigaction* before) {
    struct sigaction action = {};
    action.sa_handler = on_signal;
    action.sa_flags = SA_RESTART;
    for (std::size_t i = 0; i < std::size(heeded); ++i) {
        struct sigaction was = {};
        sigaction(heeded[i], nullptr, &was);
        if (heeded[i] != SIGHUP || was.sa_handler != SIG_IGN) {
            sigaction(heeded[i], &action, nullptr);
        }
        if (before != nullptr) {
            before[i] = was;
        }
    }
}

}  // namespace

void end_on_signals() {
    heed_signals(nullptr);
}

InterruptGuard::InterruptGuard() : before_() {
    static_assert(std::size(heeded) == std::size(decltype(before_){}));
    interrupt_requested = false;
    first_signal = 0;
    first_at = 0;
    guarded = true;
    heed_signals(before_);
}

InterruptGuard::~InterruptGuard() {
    for (std::size_t i = 0; i < std::size(heeded); ++i) {
        sigaction(heeded[i], &before_[i], nullptr);
    }
    guarded = false;
}

const std::atomic<bool>& InterruptGuard::requested() const {
    return interrupt_requested;
}

int interrupt_exit_code() {
    return first_signal == 0 ? exit_interrupted : 128 + first_signal;
}

}  // namespace diptych::core::app
