// Ctrl-C as a wish to stop, not a death.
#pragma once

#include <atomic>

namespace diptych::core::app {

/// While it lives, the first SIGINT or SIGTERM sets `requested`; the second one kills, as ever. One at a time.
class InterruptGuard {
public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    const std::atomic<bool>& requested() const;
};

}  // namespace diptych::core::app
