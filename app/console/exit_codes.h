// What the program ends with.
#pragma once

namespace diptych::core::app {

enum ExitCode { exit_done = 0, exit_check_failed = 1, exit_bad_input = 2, exit_no_device = 3, exit_interrupted = 130 };

}  // namespace diptych::core::app
