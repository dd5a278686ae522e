// Elapsed wall time, by a clock that never goes back.
#pragma once

#include <chrono>

namespace diptych::core {

/// Seconds since a start that is the same for the whole process.
inline double now_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Seconds since it was made.
class Stopwatch {
public:
    double seconds() const { return now_seconds() - start_; }

private:
    double start_ = now_seconds();
};

}  // namespace diptych::core
