// What of a chart is drawn, and where.
#pragma once

#include <string>
#include <vector>

#include "chart/chart.h"
#include "chart/svg.h"

namespace diptych::core::chart {

constexpr double font_size = 13;
constexpr double row_height = 18;  // of names and notes

struct Layout {
    Range x;
    Range y;
    std::vector<Tick> x_ticks;
    std::vector<Tick> y_ticks;
    double left = 0;  // the edges of the plot within the document
    double right = 0;
    double top = 0;
    double bottom = 0;
    double height = 0;               // of the document
    std::vector<std::string> notes;  // below the chart
    bool empty = false;              // no point can be shown

    Point2 place(const Chart& chart, double px, double py) const;
};

/// The points of a series that the axes can show.
std::vector<Point> shown_points(const Chart& chart, const Series& series);

Layout layout_of(const Chart& chart);

/// Where the names above the plot begin: in rows that keep within the width.
std::vector<Point2> places_of_names(const Chart& chart);

}  // namespace diptych::core::chart
