#include "console/interrupt.h"

#include <csignal>

namespace diptych::core::app {

namespace {

std::atomic<bool> interrupt_requested = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may touch nothing else");

// Both signals go back to killing, so that a second one of either kind is not swallowed.
void request_interrupt(int) {
    interrupt_requested = true;
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

}  // namespace

InterruptGuard::InterruptGuard() {
    interrupt_requested = false;
    std::signal(SIGINT, request_interrupt);
    std::signal(SIGTERM, request_interrupt);
}

InterruptGuard::~InterruptGuard() {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

const std::atomic<bool>& InterruptGuard::requested() const {
    return interrupt_requested;
}

}  // namespace diptych::core::app
