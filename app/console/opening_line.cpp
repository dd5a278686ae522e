#include "console/opening_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include "console/output.h"
#include "console/progress_line.h"

namespace diptych::core::app {

OpeningLine::OpeningLine(bool quiet) : shows_(!quiet), terminal_(isatty(STDERR_FILENO) == 1) {}

OpeningLine::~OpeningLine() {
    close();
}

void OpeningLine::begin(const std::string& what) {
    if (!shows_) {
        return;
    }
    end_step();
    what_ = what;
    watch_ = Stopwatch();
    if (terminal_) {
        print_message("\r{}\x1b[K", what);
    }
}

void OpeningLine::close() {
    end_step();
    shows_ = false;
}

void OpeningLine::end_step() {
    const double seconds = watch_.seconds();
    if (what_.empty()) {
        return;
    }
    if (terminal_) {
        print_message("\r\x1b[K");
    } else if (seconds >= first_sparse_line) {
        print_message("{}: {:.1f} s\n", what_, seconds);
    }
    what_.clear();
}

}  // namespace diptych::core::app
