// A plot as SVG: error over the parameter on logarithmic axes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "commands/stability/report.h"

namespace diptych::core::app {

namespace {

constexpr double width = 640;
constexpr double height = 400;
constexpr double left = 76;
constexpr double right = 20;
constexpr double top = 44;
constexpr double bottom = 52;
// Okabe and Ito's colours, which the colour-blind tell apart.
constexpr const char* colors[] = {"#0072b2", "#d55e00"};
constexpr double dashes[] = {0, 5};

std::string escaped(const std::string& text) {
    std::string safe;
    for (const char c : text) {
        safe += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
    }
    return safe;
}

struct Axis {
    double low;
    double high;
    bool logarithmic;

    double share(double value) const {
        if (!logarithmic) {
            return (value - low) / (high - low);
        }
        return (std::log10(std::max(value, low)) - std::log10(low)) / (std::log10(high) - std::log10(low));
    }
    /// About half a dozen round numbers.
    std::vector<double> ticks() const {
        std::vector<double> at;
        if (logarithmic) {
            const int first = static_cast<int>(std::floor(std::log10(low) + 1e-9));
            const int last = static_cast<int>(std::ceil(std::log10(high) - 1e-9));
            const int step = std::max(1, (last - first + 5) / 6);
            for (int e = first; e <= last; e += step) {
                at.push_back(std::pow(10.0, e));
            }
        } else {
            const double step = std::pow(10.0, std::floor(std::log10((high - low) / 2)));
            const double by = (high - low) / step > 12 ? 5 * step : (high - low) / step > 6 ? 2 * step : step;
            for (double x = std::ceil(low / by - 1e-9) * by; x <= high + 1e-9 * by; x += by) {
                at.push_back(x);
            }
        }
        return at;
    }
};

Axis parameter_axis(const MeasuredCase& m) {
    const auto& points = m.results.front().points;
    return {points.front().parameter, points.back().parameter, m.which->range.logarithmic};
}

/// Whole decades about the errors and the bound; exact results lie on its floor.
Axis error_axis(const MeasuredCase& m) {
    double low = m.which->bound > 0 ? m.which->bound / 10 : 1e-9;
    double high = std::max(m.which->bound, 1e-8);
    for (const stability::CaseResult& r : m.results) {
        for (const stability::PointResult& p : r.points) {
            if (p.measured.error > 0) {
                low = std::min(low, p.measured.error);
                high = std::max(high, p.measured.error);
            }
        }
    }
    return {std::pow(10.0, std::floor(std::log10(low))), std::pow(10.0, std::ceil(std::log10(high * 1.5))), true};
}

double place_x(const Axis& axis, double value) {
    return left + (width - left - right) * std::clamp(axis.share(value), 0.0, 1.0);
}

double place_y(const Axis& axis, double value) {
    return height - bottom - (height - top - bottom) * std::clamp(axis.share(value), 0.0, 1.0);
}

std::string line(double x1, double y1, double x2, double y2, const std::string& style) {
    return fmt::format("<line x1='{:.1f}' y1='{:.1f}' x2='{:.1f}' y2='{:.1f}' {}/>\n", x1, y1, x2, y2, style);
}

std::string label(double x, double y, const char* anchor, const std::string& text, const std::string& more = "") {
    return fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='{}' {}>{}</text>\n", x, y, anchor, more,
                       escaped(text));
}

std::string axes(const MeasuredCase& m, const Axis& x, const Axis& y) {
    std::string svg;
    for (const double value : y.ticks()) {
        const double at = place_y(y, value);
        svg += line(left, at, width - right, at, "stroke='#dddddd'");
        svg += label(left - 6, at + 4, "end", fmt::format("{:g}", value));
    }
    for (const double value : x.ticks()) {
        const double at = place_x(x, value);
        if (x.share(value) > -1e-6 && x.share(value) < 1 + 1e-6) {
            svg += line(at, top, at, height - bottom, "stroke='#dddddd'");
            svg += label(at, height - bottom + 18, "middle", fmt::format("{:g}", value));
        }
    }
    svg += label((left + width - right) / 2, height - 12, "middle", m.which->range.parameter);
    const double middle = (top + height - bottom) / 2;
    svg += label(16, middle, "middle", fmt::format("error, {}", m.which->measure),
                 fmt::format("transform='rotate(-90 16 {:.1f})'", middle));
    return svg;
}

}  // namespace

std::string plot_case(const StabilityReport& report, const MeasuredCase& measured) {
    const Axis x = parameter_axis(measured);
    const Axis y = error_axis(measured);
    std::string svg =
        fmt::format("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0} {1}' width='{0}' height='{1}' "
                    "font-family='sans-serif' font-size='12' fill='#222222'>\n"
                    "<rect width='{0}' height='{1}' fill='#ffffff'/>\n",
                    width, height);
    svg += label(left, 18, "start", fmt::format("{}: {}", measured.which->row, measured.which->name), "font-size='14'");
    svg += axes(measured, x, y);
    if (measured.which->bound > 0) {
        const double at = place_y(y, measured.which->bound);
        svg += line(left, at, width - right, at, "stroke='#b00020' stroke-dasharray='2 3'");
        svg +=
            label(width - right - 4, at - 5, "end", fmt::format("bound {:g}", measured.which->bound), "fill='#b00020'");
    }
    double legend = left;
    for (std::size_t b = 0; b < measured.results.size(); ++b) {
        std::string curve;
        for (const stability::PointResult& p : measured.results[b].points) {
            curve += fmt::format("{:.1f},{:.1f} ", place_x(x, p.parameter), place_y(y, p.measured.error));
        }
        const std::string style =
            fmt::format("stroke='{}' stroke-width='2' stroke-dasharray='{:g}'", colors[b % 2], dashes[b % 2]);
        svg += fmt::format("<polyline fill='none' {} points='{}'/>\n", style, curve);
        svg += line(legend, 32, legend + 24, 32, style);
        const std::string name = fmt::format("{} ({})", report.backends[b].name, report.backends[b].device);
        svg += label(legend + 30, 36, "start", name, "font-size='11'");
        legend += 50 + 6.2 * static_cast<double>(name.size());
    }
    return svg + "</svg>\n";
}

}  // namespace diptych::core::app
