// How a command of many steps is getting on, in one line on stderr.
#pragma once

#include <string>

#include "clock.h"

namespace diptych::core::app {

/// Redrawn in place on a terminal; elsewhere a line after 2 seconds and at each doubling of the time. On a terminal the
/// line goes when this dies: what the steps found follows it.
class StepLine {
public:
    explicit StepLine(int steps);
    ~StepLine();
    StepLine(const StepLine&) = delete;
    StepLine& operator=(const StepLine&) = delete;

    /// One step begins: "3/30 steps  path, frame 2  ETA 0:12". The time left is guessed from the steps so far.
    void begin(const std::string& what);

private:
    int steps_;
    int begun_ = 0;
    bool terminal_;
    double next_;
    Stopwatch watch_;
};

}  // namespace diptych::core::app
