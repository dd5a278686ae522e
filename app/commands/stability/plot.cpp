// A plot as SVG: error over the parameter on logarithmic axes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "chart/chart.h"
#include "chart/number_text.h"
#include "commands/stability/report.h"

namespace diptych::core::app {

namespace {

/// Whole decades around the errors and the bound.
chart::Range error_range(const stability::MeasuredCase& m) {
    double low = m.which->bound > 0 ? m.which->bound / 10 : 1e-9;
    double high = std::max(m.which->bound, 1e-8);
    for (const stability::CaseResult& r : m.results) {
        for (const stability::PointResult& p : r.points) {
            if (p.measured.error > 0 && std::isfinite(p.measured.error)) {
                low = std::min(low, p.measured.error);
                high = std::max(high, p.measured.error);
            }
        }
    }
    return {std::pow(10.0, std::floor(std::log10(low))), std::pow(10.0, std::ceil(std::log10(high * 1.5)))};
}

}  // namespace

std::string plot_case(const stability::Report& report, const stability::MeasuredCase& measured) {
    const stability::Case& which = *measured.which;
    const auto& points = measured.results.front().points;
    const chart::Range errors = error_range(measured);
    chart::Chart chart;
    chart.title = fmt::format("{}: {}", which.row, which.name);
    chart.x = {which.range.parameter, which.range.logarithmic ? chart::Scale::decimal : chart::Scale::linear,
               chart::TickText::number, points.front().parameter, points.back().parameter};
    chart.y = {fmt::format("error, {}", which.measure), chart::Scale::decimal, chart::TickText::number, errors.low,
               errors.high};
    bool exact = false;
    for (std::size_t b = 0; b < measured.results.size(); ++b) {
        chart::Series series{fmt::format("{} ({})", report.backends[b].name, report.backends[b].device), {}, {}};
        for (const stability::PointResult& p : measured.results[b].points) {
            exact = exact || p.measured.error == 0;
            series.points.push_back({p.parameter, p.measured.error == 0 ? errors.low : p.measured.error,
                                     chart::no_band, chart::no_band, p.measured.where});
        }
        chart.series.push_back(series);
    }
    if (exact) {
        chart.note = "Exact results lie on the lower edge.";
    }
    if (which.bound > 0) {
        chart.marks = {{which.bound, "bound " + chart::figure_text(which.bound)}};
    }
    chart.names = chart::Names::above;
    chart.width = 640;
    chart.height = 420;
    return chart_svg(chart);
}

}  // namespace diptych::core::app
