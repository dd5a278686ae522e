// What the colours of a layer of numbers mean.
#pragma once

#include <string>

namespace diptych::core::app {

/// What a ramp of colours means.
struct Legend {
    bool shown = false;
    bool difference = false;  // from -high to high
    bool logarithmic = false;
    double low = 0;
    double high = 1;
    std::string unit;
};

}  // namespace diptych::core::app
