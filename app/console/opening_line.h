// What a command does before its first sample, in one line on stderr.
#pragma once

#include <string>

#include "clock.h"

namespace diptych::core::app {

/// On a terminal the step at hand, in a line that goes when this ends. Elsewhere a line after each step that took as long
/// as a first progress line waits: "compiling 9 pipelines: 8.1 s".
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
