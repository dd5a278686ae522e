// A chart as plain data, and the SVG of it.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "chart/axis.h"

namespace diptych::core::chart {

/// Colours of the series, which colour-blind readers can tell apart: Okabe and Ito's, the pale ones darkened so that
/// text in them can be read on white. The ninth series has the first colour again, dashed.
const std::vector<std::string>& series_colors();

constexpr double no_band = std::numeric_limits<double>::quiet_NaN();

struct Point {
    double x = 0;
    double y = 0;
    double low = no_band;  // of the band around y, such as a confidence interval
    double high = no_band;
    std::string note = {};  // shown where a reader points at it
};

enum class Shape { line, bars };  // bars stand from the axis to each point, next to one another

struct Series {
    std::string name;
    std::vector<Point> points;
    Shape shape = Shape::line;
};

struct Axis {
    std::string label;
    Scale scale = Scale::linear;
    TickText text = TickText::number;
    std::optional<double> low;  // else what the series need
    std::optional<double> high;
};

/// A horizontal line, such as a bound.
struct Mark {
    double y = 0;
    std::string text;
};

enum class Names { at_ends, above, none };  // where the names of the series stand

struct Chart {
    std::string title;
    Axis x;
    Axis y;
    std::vector<Series> series;
    std::vector<Mark> marks;
    std::optional<double> guide;  // dotted: y as x to this power, through the middle of two logarithmic axes
    std::string note;  // below the chart
    Names names = Names::at_ends;
    double width = 800;
    double height = 520;  // more, if the names at the lines' ends need it
};

/// A point that an axis cannot show (not finite, or not above zero on a logarithmic axis) is left out, and the chart
/// says how many were.
std::string chart_svg(const Chart& chart);

}  // namespace diptych::core::chart
