#include "console/step_line.h"

#include <unistd.h>

#include <algorithm>

#include "console/output.h"
#include "console/progress_line.h"

namespace diptych::core::app {

StepLine::StepLine(int steps)
    : steps_(steps), terminal_(isatty(STDERR_FILENO) == 1), next_(terminal_ ? 0 : first_sparse_line) {}

StepLine::~StepLine() {
    if (terminal_ && begun_ > 0) {
        print_message("\r\x1b[K");
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
    print_message("{}{}/{} steps  {}{}{}", terminal_ ? "\r" : "", begun_, std::max(steps_, begun_), what, left,
                  terminal_ ? "\x1b[K" : "\n");
}

}  // namespace diptych::core::app
