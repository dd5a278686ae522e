// The program as a whole.
#pragma once

namespace diptych::core::app {

/// Parses the command line and runs the command that it names. Returns the exit code (command.h); what is thrown
/// becomes one line on stderr.
int run_program(int argc, char** argv);

}  // namespace diptych::core::app
