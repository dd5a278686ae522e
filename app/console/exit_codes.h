// What the program ends with.
#pragma once

namespace diptych::core::app {

/// exit_interrupted is that of SIGINT; interrupt_exit_code() (interrupt.h) gives that of the signal that came.
enum ExitCode { exit_done = 0, exit_check_failed = 1, exit_bad_input = 2, exit_no_device = 3, exit_interrupted = 130 };

}  // namespace diptych::core::app
