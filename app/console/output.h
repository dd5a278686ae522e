// The one place that writes to stdout and stderr.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

namespace diptych::core::app {

/// A message on stderr. Where it cannot be written (closed, full, broken pipe), it is dropped: no message is worth a
/// render. From any thread.
void write_message(std::string_view text);

/// On stdout, about a file that has been written. Dropped likewise, because the file is the result.
void write_note(std::string_view text);

/// A result on stdout. What cannot be written is lost, unless the reader of a pipe has gone: such a reader has seen
/// enough.
void write_result(std::string_view text);

/// A result for a program, on stdout: lost wherever it cannot be written.
void write_data(std::string_view text);

/// From now on nothing is written: the process is one of several, and another one speaks for all.
void silence_output();

/// Why results or data were lost; empty where none were.
std::string reason_of_loss();

template <class... Arguments>
void print_message(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
    write_message(fmt::format(text, std::forward<Arguments>(arguments)...));
}

template <class... Arguments>
void print_note(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
    write_note(fmt::format(text, std::forward<Arguments>(arguments)...));
}

template <class... Arguments>
void print_result(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
    write_result(fmt::format(text, std::forward<Arguments>(arguments)...));
}

}  // namespace diptych::core::app
