// A map of cells in colours, with a bar that says what the colours mean.
#pragma once

#include <string>
#include <vector>

#include "chart/axis.h"

namespace diptych::core::chart {

/// A colour that stands for no value.
struct Key {
    std::string color;  // "#00ffff"
    std::string text;
};

struct HeatMap {
    std::string title;
    std::string label;  // of the values
    Range range;        // of the colours
    std::string cells;  // PNG
    double width = 0;   // that the cells are drawn at
    double height = 0;
    std::string bar;  // PNG of the range's colours, from its high end at the top to its low end
    std::vector<Key> keys;
};

std::string heat_map_svg(const HeatMap& map);

}  // namespace diptych::core::chart
