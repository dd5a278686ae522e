// Ctrl-C and the signals of schedulers as a wish to stop, not a death.
#pragma once

#include <atomic>
#include <csignal>

namespace diptych::core::app {

/// For the start of the program: from now on SIGINT, SIGTERM, SIGHUP or SIGXCPU (number n) end the program at once with
/// 128 + n and a line on stderr, except while an InterruptGuard lives. A SIGHUP that is ignored, as nohup has it, stays
/// ignored.
void end_on_signals();

/// While it lives, the first of these signals sets `requested`; a second one ends the program at once. Two of them within
/// a fifth of a second are one: a terminal that closes and `timeout` both signal a process twice. SIGXCPU is no second
/// one, because the kernel repeats it every second until the hard limit. One guard at a time.
class InterruptGuard {
public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    const std::atomic<bool>& requested() const;

private:
    struct sigaction before_[4];  // what the signals did before
};

/// What an interrupted program ends with: 128 + the number of the signal that the latest guard has met.
int interrupt_exit_code();

}  // namespace diptych::core::app
