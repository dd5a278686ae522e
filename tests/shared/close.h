#pragma once

#include <cmath>

namespace diptych::core::tests {

/// |a - b| <= relative |b|.
inline bool close(double a, double b, double relative) {
    return std::abs(a - b) <= relative * std::abs(b);
}

}  // namespace diptych::core::tests
