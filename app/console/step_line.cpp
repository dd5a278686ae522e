#include "console/step_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "console/progress_line.h"

namespace diptych::core::app {

StepLine::StepLine(int steps)
    : steps_(steps), terminal_(isatty(STDERR_FILENO) == 1), next_(terminal_ ? 0 : first_sparse_line) {}

StepLine::~StepLine() {
    if (terminal_ && begun_ > 0) {
        fmt::print(stderr, "\r\x1b[K");
        std::fflush(stderr);
    }
}

void StepLine::begin(const std::string& what) {
    const double seconds = watch_.seconds();
    const int done = begun_++;
    if (seconds < next_) {
        return;
    }
    next_ = terminal_ ? seconds + terminal_interval : 2 * seconds;
    const std::string left = done > 0 ? "  ETA " + clock_text(seconds / done * (steps_ - done)) : "";
    fmt::print(stderr, "{}{}/{} steps  {}{}{}", terminal_ ? "\r" : "", begun_, std::max(steps_, begun_), what, left,
               terminal_ ? "\x1b[K" : "\n");
    std::fflush(stderr);
}

}  // namespace diptych::core::app
