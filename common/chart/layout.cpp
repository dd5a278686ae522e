#include "chart/layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace diptych::core::chart {

namespace {

constexpr double edge = 16;
constexpr double title_height = 28;
constexpr double name_line = 24;  // the piece of line before a name above the plot

/// The axis's own ends; else around the values, with some air between them and the ends.
Range range_of(const Axis& axis, const std::vector<double>& values) {
    Range range{1, 1};
    if (!values.empty()) {
        const auto [least, most] = std::minmax_element(values.begin(), values.end());
        range = {*least, *most};
    }
    if (is_logarithmic(axis.scale)) {
        range = {axis.low.value_or(range.low / 1.25), axis.high.value_or(range.high * 1.25)};
        return range.low < range.high ? range : Range{range.low / 2, range.low * 2};
    }
    const double air = 0.05 * (range.high - range.low);
    range = {axis.low.value_or(range.low - air), axis.high.value_or(range.high + air)};
    const double half = std::max(std::abs(range.low) / 2, 0.5);
    return range.low < range.high ? range : Range{range.low - half, range.low + half};
}

/// A band may reach below what is drawn, so only its high ends widen the range.
Range y_range(const Chart& chart) {
    std::vector<double> values;
    for (const Series& series : chart.series) {
        for (const Point& point : shown_points(chart, series)) {
            values.push_back(point.y);
            if (can_show(chart.y.scale, point.high)) {
                values.push_back(point.high);
            }
        }
    }
    for (const Mark& mark : chart.marks) {
        if (can_show(chart.y.scale, mark.y)) {
            values.push_back(mark.y);
        }
    }
    return range_of(chart.y, values);
}

Range x_range(const Chart& chart) {
    std::vector<double> values;
    for (const Series& series : chart.series) {
        for (const Point& point : shown_points(chart, series)) {
            values.push_back(point.x);
        }
    }
    return range_of(chart.x, values);
}

double widest(const std::vector<Tick>& ticks) {
    double width = 0;
    for (const Tick& tick : ticks) {
        width = std::max(width, text_width(tick.text, font_size));
    }
    return width;
}

double widest_name(const Chart& chart) {
    double width = 0;
    for (const Series& series : chart.series) {
        width = std::max(width, text_width(series.name, font_size));
    }
    return width;
}

/// As many ticks as their labels leave room for.
std::vector<Tick> x_ticks_within(const Chart& chart, const Range& range, double room) {
    std::vector<Tick> ticks;
    for (int most = 14; most >= 2; --most) {
        ticks = axis_ticks(chart.x.scale, range, most, chart.x.text);
        const auto labels = std::count_if(ticks.begin(), ticks.end(), [](const Tick& t) { return !t.text.empty(); });
        if (static_cast<double>(labels) * (widest(ticks) + 14) <= room) {
            return ticks;
        }
    }
    return ticks;
}

}  // namespace

Point2 Layout::place(const Chart& chart, double px, double py) const {
    return {left + share_of(chart.x.scale, x, px) * (right - left),
            bottom - share_of(chart.y.scale, y, py) * (bottom - top)};
}

std::vector<Point> shown_points(const Chart& chart, const Series& series) {
    std::vector<Point> shown;
    std::copy_if(series.points.begin(), series.points.end(), std::back_inserter(shown), [&](const Point& point) {
        return can_show(chart.x.scale, point.x) && can_show(chart.y.scale, point.y);
    });
    return shown;
}

std::vector<Point2> places_of_names(const Chart& chart) {
    std::vector<Point2> places;
    double x = edge;
    double y = edge + (chart.title.empty() ? 4 : title_height);
    for (const Series& series : chart.series) {
        const double width = name_line + 6 + text_width(series.name, font_size);
        if (x > edge && x + width > chart.width - edge) {
            x = edge;
            y += row_height;
        }
        places.push_back({x, y});
        x += width + 20;
    }
    return places;
}

Layout layout_of(const Chart& chart) {
    Layout layout;
    std::size_t points = 0;
    std::size_t shown = 0;
    for (const Series& series : chart.series) {
        points += series.points.size();
        shown += shown_points(chart, series).size();
    }
    layout.empty = shown == 0;
    if (!chart.note.empty()) {
        layout.notes.push_back(chart.note);
    }
    if (shown < points && shown > 0) {
        layout.notes.push_back(
            fmt::format("Not drawn: {} of {} points, which {}", points - shown, points,
                        is_logarithmic(chart.x.scale) || is_logarithmic(chart.y.scale)
                            ? "are zero, negative or not finite"
                            : "are not finite"));
    }
    const bool names_above = chart.names == Names::above && !chart.series.empty();
    const bool names_at_ends = chart.names == Names::at_ends && !chart.series.empty();
    const double head = names_above ? places_of_names(chart).back().y + 10 : chart.title.empty() ? 6 : title_height + 8;
    layout.top = head + 28;  // the label of y has a row of its own
    const double below = 24 + row_height + 6 + row_height * static_cast<double>(layout.notes.size());
    const double least = names_at_ends ? row_height * static_cast<double>(chart.series.size()) : 0;
    layout.height = std::max(chart.height, layout.top + below + least);
    layout.bottom = layout.height - below;
    layout.x = x_range(chart);
    layout.y = y_range(chart);
    layout.y_ticks = axis_ticks(chart.y.scale, layout.y, std::max(2, static_cast<int>((layout.bottom - layout.top) / 32)),
                                chart.y.text);
    layout.left = edge + widest(layout.y_ticks) + 8;
    layout.right = chart.width - (names_at_ends ? edge + 18 + widest_name(chart) : edge + 4);
    layout.x_ticks = x_ticks_within(chart, layout.x, layout.right - layout.left);
    layout.right = std::min(layout.right, chart.width - widest(layout.x_ticks) / 2 - 4);  // a label may stand at the end
    return layout;
}

}  // namespace diptych::core::chart
