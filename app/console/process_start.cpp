#include "console/process_start.h"

#include <csignal>

#include <fcntl.h>
#include <unistd.h>

#include "console/interrupt.h"

namespace diptych::core::app {

namespace {

bool no_stdout = false;

bool is_closed(int descriptor) {
    return ::fcntl(descriptor, F_GETFD) == -1;
}

}  // namespace

void prepare_process() {
    no_stdout = is_closed(STDOUT_FILENO);
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (is_closed(descriptor)) {
            // `open` takes the lowest descriptor that is free, which is this one.
            [[maybe_unused]] const int opened =
                ::open("/dev/null", descriptor == STDIN_FILENO ? O_RDONLY : O_WRONLY);
        }
    }
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    end_on_signals();
}

bool stdout_was_closed() {
    return no_stdout;
}

}  // namespace diptych::core::app
