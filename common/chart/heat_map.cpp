#include "chart/heat_map.h"

#include <fmt/format.h>

#include <algorithm>

#include "chart/svg.h"

namespace diptych::core::chart {

namespace {

constexpr double map_edge = 16;
constexpr double bar_width = 18;
constexpr double least_bar_height = 160;
constexpr double row = 22;

std::string image(Point2 at, double width, double height, const std::string& png) {
    return fmt::format("<image x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" "
                       "preserveAspectRatio=\"none\" style=\"image-rendering:pixelated\" href=\"{}\"/>\n",
                       at.x, at.y, width, height, png_uri(png));
}

}  // namespace

std::string heat_map_svg(const HeatMap& map) {
    const double top = 62;
    const double bar_left = map_edge + map.width + 24;
    const double bar_height = std::max(map.height, least_bar_height);
    std::string svg = svg_title(map.title, 0);
    svg += image({map_edge, top}, map.width, map.height, map.cells);
    svg += image({bar_left, top}, bar_width, bar_height, map.bar);
    svg += svg_label({bar_left, top - 10}, "start", map.label, "class=\"axis\" fill=\"#1d1f24\" font-weight=\"600\"");
    for (const Tick& tick : axis_ticks(Scale::linear, map.range, 8)) {
        const double y = top + bar_height * (1 - share_of(Scale::linear, map.range, tick.value));
        svg += svg_line({bar_left + bar_width, y}, {bar_left + bar_width + 5, y}, "stroke=\"#4a505a\"");
        svg += svg_label({bar_left + bar_width + 10, y + 4.5}, "start", tick.text);
    }
    double width = std::max(bar_left + text_width(map.label, 13), map_edge + text_width(map.title, 16));
    double y = top + bar_height + 14;
    for (const Key& key : map.keys) {
        svg += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"14\" height=\"14\" fill=\"{}\"/>\n", map_edge, y,
                           xml_text(key.color));
        svg += svg_label({map_edge + 22, y + 11.5}, "start", key.text);
        width = std::max(width, map_edge + 22 + text_width(key.text, 13));
        y += row;
    }
    return svg_document(width + map_edge, y + 4, map.title, svg);
}

}  // namespace diptych::core::chart
