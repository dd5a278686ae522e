// What a command does before its first sample, in one line on stderr.
#pragma once

#include <string>

#include "clock.h"

namespace diptych::core::app {

/// On a terminal it shows the current step, in a line that it clears at the end. Elsewhere it prints a line after each
/// step that took at least first_sparse_line seconds: "compiling 9 pipelines: 8.1 s".
class OpeningLine {
public:
    explicit OpeningLine(bool quiet = false);
    ~OpeningLine();
    OpeningLine(const OpeningLine&) = delete;
    OpeningLine& operator=(const OpeningLine&) = delete;

    void begin(const std::string& what);
    /// The first sample comes. Steps that begin later are not shown.
    void close();

private:
    void end_step();

    bool shows_;
    bool terminal_;
    std::string what_;  // empty between steps
    Stopwatch watch_;
};

}  // namespace diptych::core::app
