// What the program settles about its process before it does anything else.
#pragma once

namespace diptych::core::app {

/// Opens /dev/null in the place of standard streams that are closed: a picture would be opened as descriptor 2, and
/// messages would be written into it. Ignores SIGPIPE and SIGXFSZ, so that a broken pipe and a file above `ulimit -f`
/// are errors of the write, with a reason. Signals end the program with 128 + n (interrupt.h).
void prepare_process();

/// Whether stdout was closed when the program began.
bool stdout_was_closed();

}  // namespace diptych::core::app
