#include "chart/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "chart/layout.h"
#include "chart/svg.h"

namespace diptych::core::chart {

namespace {

constexpr std::size_t most_dots = 40;  // of a line; more of them would hide it
constexpr const char* halo = "stroke=\"#ffffff\" stroke-width=\"4\" stroke-linejoin=\"round\" paint-order=\"stroke\"";

const std::string& color_of(std::size_t index) {
    return series_colors()[index % series_colors().size()];
}

std::string dash_of(std::size_t index) {
    return index >= series_colors().size() ? " stroke-dasharray=\"6 4\"" : "";
}

std::string coordinates(Point2 at) {
    return fmt::format("{:.1f},{:.1f}", at.x, at.y);
}

std::string note_element(const std::string& note) {
    return note.empty() ? "" : "<title>" + xml_text(note) + "</title>";
}

std::string frame(const Chart& chart, const Layout& l) {
    std::string svg = "<g class=\"grid\" stroke=\"#e2e2e2\">\n";
    for (const Tick& tick : l.y_ticks) {
        const double y = l.place(chart, l.x.low, tick.value).y;
        svg += svg_line({l.left, y}, {l.right, y}, tick.text.empty() ? "opacity=\"0.6\"" : "");
    }
    for (const Tick& tick : l.x_ticks) {
        const double x = l.place(chart, tick.value, l.y.low).x;
        svg += svg_line({x, l.top}, {x, l.bottom}, tick.text.empty() ? "opacity=\"0.6\"" : "");
    }
    svg += "</g>\n<g class=\"ticks\">\n";
    for (const Tick& tick : l.y_ticks) {
        if (!tick.text.empty()) {
            svg += svg_label({l.left - 8, l.place(chart, l.x.low, tick.value).y + 4.5}, "end", tick.text);
        }
    }
    for (const Tick& tick : l.x_ticks) {
        if (!tick.text.empty()) {
            svg += svg_label({l.place(chart, tick.value, l.y.low).x, l.bottom + 18}, "middle", tick.text);
        }
    }
    svg += "</g>\n<g class=\"axis\" fill=\"#1d1f24\" font-weight=\"600\">\n";
    svg += svg_label({(l.left + l.right) / 2, l.bottom + 40}, "middle", chart.x.label);
    svg += svg_label({16, l.top - 14}, "start", chart.y.label);
    return svg + "</g>\n";
}

/// As far as the line stays within the plot, less a margin.
std::string guide_line(const Chart& chart, const Layout& l) {
    const double slope = *chart.guide;
    const double x = std::sqrt(l.x.low * l.x.high);
    const double y = std::sqrt(l.y.low * l.y.high);
    const double reach = std::pow(std::min(l.x.high / x, std::pow(l.y.high / y, 1 / std::abs(slope))), 0.92);
    return svg_line(l.place(chart, x / reach, y / std::pow(reach, slope)),
                    l.place(chart, x * reach, y * std::pow(reach, slope)),
                    "class=\"guide\" stroke=\"#4a505a\" stroke-dasharray=\"2 5\"");
}

std::string mark_lines(const Chart& chart, const Layout& l) {
    std::string svg;
    for (const Mark& mark : chart.marks) {
        if (can_show(chart.y.scale, mark.y)) {
            const double y = l.place(chart, l.x.low, mark.y).y;
            svg += svg_line({l.left, y}, {l.right, y}, "class=\"mark\" stroke=\"#1d1f24\" stroke-dasharray=\"5 4\"");
            svg += svg_label({l.right - 4, y - 6}, "end", mark.text, std::string("class=\"halo\" ") + halo);
        }
    }
    return svg;
}

/// The area between low and high; a low end that the axis cannot show lies at the bottom.
std::string band(const Chart& chart, const Layout& l, const std::vector<Point>& points) {
    std::string upper;
    std::string lower;
    for (const Point& point : points) {
        if (std::isfinite(point.low) && can_show(chart.y.scale, point.high)) {
            upper += (upper.empty() ? "" : "L") + coordinates(l.place(chart, point.x, point.high));
            lower = "L" + coordinates(l.place(chart, point.x, point.low)) + lower;
        }
    }
    return upper.find('L') == std::string::npos
               ? ""
               : fmt::format("<path class=\"band\" stroke=\"none\" opacity=\"0.15\" d=\"M{}{}Z\"/>\n", upper, lower);
}

std::string line(const Chart& chart, const Layout& l, const std::vector<Point>& points, std::size_t index) {
    std::string path;
    std::string dots;
    for (const Point& point : points) {
        const Point2 at = l.place(chart, point.x, point.y);
        path += (path.empty() ? "" : " ") + coordinates(at);
        if (points.size() <= most_dots) {
            dots += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.2\">{}</circle>\n", at.x, at.y,
                                note_element(point.note));
        }
    }
    return band(chart, l, points) +
           fmt::format("<polyline fill=\"none\" stroke-width=\"2.2\" stroke-linejoin=\"round\"{} points=\"{}\"/>\n",
                       dash_of(index), path) +
           (dots.empty() ? "" : "<g stroke=\"none\">\n" + dots + "</g>\n");
}

std::string bars(const Chart& chart, const Layout& l, const std::vector<Point>& points) {
    std::string svg;
    const double room = (l.right - l.left) / static_cast<double>(points.size());
    for (const Point& point : points) {
        const Point2 at = l.place(chart, point.x, point.y);
        svg += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" stroke=\"none\" "
                           "opacity=\"0.8\">{}</rect>\n",
                           at.x - 0.46 * room, at.y, 0.92 * room, l.bottom - at.y, note_element(point.note));
    }
    return svg;
}

/// Where the names at the lines' ends stand: at the end of their line, and moved apart where they would overlap.
std::vector<double> heights_of_names(const Chart& chart, const Layout& l) {
    std::vector<double> heights(chart.series.size(), l.top);
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < chart.series.size(); ++i) {
        const std::vector<Point> points = shown_points(chart, chart.series[i]);
        if (!points.empty()) {
            heights[i] = l.place(chart, points.back().x, points.back().y).y;
            order.push_back(i);
        }
    }
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return heights[a] < heights[b]; });
    double least = l.top;
    for (const std::size_t i : order) {  // down from the top, then up from the bottom, where there is room for all
        heights[i] = std::max(heights[i], least);
        least = heights[i] + row_height;
    }
    double most = l.bottom;
    for (auto i = order.rbegin(); i != order.rend(); ++i) {
        heights[*i] = std::min(heights[*i], most);
        most = heights[*i] - row_height;
    }
    return heights;
}

std::string name_at_end(const Chart& chart, const Layout& l, const std::vector<Point>& points, const std::string& name,
                        double height) {
    const Point2 last = l.place(chart, points.back().x, points.back().y);
    return svg_line({last.x + 5, last.y}, {l.right + 8, height}, "opacity=\"0.45\"") +
           svg_label({l.right + 12, height + 4.5}, "start", name, "stroke=\"none\" font-weight=\"600\"");
}

std::string name_above(Point2 at, const std::string& name, std::size_t index) {
    return svg_line(at, {at.x + 24, at.y}, "stroke-width=\"2.2\"" + dash_of(index)) +
           svg_label({at.x + 30, at.y + 4.5}, "start", name, "stroke=\"none\"");
}

std::string all_series(const Chart& chart, const Layout& l) {
    const std::vector<double> heights = heights_of_names(chart, l);
    const std::vector<Point2> places = places_of_names(chart);
    std::string svg;
    for (std::size_t i = 0; i < chart.series.size(); ++i) {
        const Series& series = chart.series[i];
        const std::vector<Point> points = shown_points(chart, series);
        svg += fmt::format("<g class=\"series color-{}\" data-series=\"{}\" fill=\"{}\" stroke=\"{}\">\n",
                           i % series_colors().size(), i, color_of(i), color_of(i));
        if (!points.empty()) {
            svg += series.shape == Shape::bars ? bars(chart, l, points) : line(chart, l, points, i);
            svg += chart.names == Names::at_ends ? name_at_end(chart, l, points, series.name, heights[i]) : "";
        }
        svg += chart.names == Names::above ? name_above(places[i], series.name, i) : "";
        svg += "</g>\n";
    }
    return svg;
}

}  // namespace

const std::vector<std::string>& series_colors() {
    static const std::vector<std::string> colors = {"#0072b2", "#d55e00", "#009e73", "#c2559a",
                                                    "#c98a00", "#3a9fd8", "#7f6000", "#666666"};
    return colors;
}

std::string chart_svg(const Chart& chart) {
    const Layout layout = layout_of(chart);
    const std::string name = chart.title.empty() ? chart.y.label + " over " + chart.x.label : chart.title;
    std::string svg;
    if (!chart.title.empty()) {
        svg += svg_title(chart.title, chart.width);
    }
    if (layout.empty) {
        svg += svg_label({chart.width / 2, layout.height / 2}, "middle",
                         is_logarithmic(chart.y.scale) ? "Nothing to draw: no value is above zero" : "Nothing to draw");
        return svg_document(chart.width, layout.height, name, svg);
    }
    svg += frame(chart, layout);
    const bool guided = chart.guide && is_logarithmic(chart.x.scale) && is_logarithmic(chart.y.scale);
    svg += guided ? guide_line(chart, layout) : "";
    svg += all_series(chart, layout) + mark_lines(chart, layout);
    for (std::size_t i = 0; i < layout.notes.size(); ++i) {
        svg += svg_label({16, layout.bottom + 62 + row_height * static_cast<double>(i)}, "start", layout.notes[i],
                         "font-size=\"12\"");
    }
    return svg_document(chart.width, layout.height, name, svg);
}

}  // namespace diptych::core::chart
