#include "measure/converge/charts.h"

#include <fmt/format.h>

#include <limits>

#include "chart/number_text.h"
#include "image/atomic_file.h"

namespace diptych::core {

namespace {

using Json = nlohmann::ordered_json;

double number(const Json& value) {
    return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

/// What is drawn of each checkpoint, with its 95 % band where there is one.
struct Quantity {
    const char* button;
    const char* label;
    const char* key;
    bool falls;  // as 1/N for independent samples
    const char* note;
};

constexpr Quantity quantities[] = {
    {"relMSE", "relMSE", "relmse", true,
     "Mean over the runs, with its 95 % band. Dotted: 1/N, as the error of independent samples falls."},
    {"Trimmed", "relMSE without the worst 0.1 %", "relmse_trimmed", true,
     "Without the 0.1 % of the pixels with the largest error, most of which are fireflies: this is how most of the "
     "picture looks. summary.csv holds the energy of these pixels. Bias is not judged by this error. Dotted: 1/N."},
    {"MSE", "MSE", "mse", true,
     "Mean over the runs, with its 95 % band. Dotted: 1/N, as the error of independent samples falls."},
    {"Efficiency", "1 / (MSE · s)", "efficiency", false,
     "Constant if the error falls as 1/N. A method that is twice as efficient needs half the time for the same error."},
    {"Bias²", "relative bias²", "relative_bias_squared", false,
     "An estimate whose expectation is the squared bias. Without bias it scatters about 0: about half of the points "
     "are negative and not drawn, and the others fall as the noise does."},
};

struct Abscissa {
    const char* button;
    const char* label;
    const char* key;
    chart::Scale scale;
    chart::TickText text;
};

constexpr Abscissa abscissae[] = {
    {"Time", "rendering time", "device_seconds", chart::Scale::decimal, chart::TickText::seconds},
    {"Wall clock", "rendering time by the wall clock", "wall_seconds", chart::Scale::decimal,
     chart::TickText::seconds},
    {"Samples", "samples per pixel", "spp", chart::Scale::binary, chart::TickText::number},
};

chart::Point point_of(const Json& checkpoint, const Quantity& quantity, const Abscissa& abscissa) {
    const Json& value = checkpoint.at(quantity.key);
    chart::Point point{number(checkpoint.at(abscissa.key)), 0, chart::no_band, chart::no_band, ""};
    if (!value.is_object()) {
        point.y = number(value);
        return point;
    }
    point.y = number(value.at("value"));
    if (value.contains("low")) {
        point.low = number(value.at("low"));
        point.high = number(value.at("high"));
    } else {  // normal noise of the mean over many pixels
        const double half = 1.96 * number(value.at("standard_error"));
        point.low = point.y - half;
        point.high = point.y + half;
    }
    return point;
}

std::string note_of(const std::string& method, const Json& checkpoint, const Quantity& quantity,
                    const chart::Point& point) {
    using namespace chart;
    const std::string band = point.low == point.low
                                 ? fmt::format(" ({} … {})", figure_text(point.low), figure_text(point.high))
                                 : "";
    return fmt::format("{}\n{} spp, {}\n{} {}{}", method, checkpoint.at("spp").get<std::uint32_t>(),
                       seconds_text(number(checkpoint.at("device_seconds"))), quantity.label, figure_text(point.y),
                       band);
}

chart::Chart chart_of(const Json& summary, const Quantity& quantity, const Abscissa& abscissa) {
    chart::Chart chart;
    chart.x = {abscissa.label, abscissa.scale, abscissa.text, {}, {}};
    chart.y = {quantity.label, chart::Scale::decimal, chart::TickText::number, {}, {}};
    for (const Json& method : summary.at("methods")) {
        chart::Series series{method.at("method"), {}, chart::Shape::line};
        for (const Json& checkpoint : method.at("checkpoints")) {
            chart::Point point = point_of(checkpoint, quantity, abscissa);
            point.note = note_of(series.name, checkpoint, quantity, point);
            series.points.push_back(point);
        }
        chart.series.push_back(series);
    }
    if (quantity.falls) {
        chart.guide = -1;
    }
    return chart;
}

}  // namespace

std::vector<ErrorChart> error_charts(const Json& summary) {
    std::vector<ErrorChart> charts;
    for (const Quantity& quantity : quantities) {
        for (const Abscissa& abscissa : abscissae) {
            charts.push_back(
                {quantity.button, abscissa.button, chart_of(summary, quantity, abscissa), quantity.note});
        }
    }
    return charts;
}

void write_charts(const Json& summary, const ConvergeState& state) {
    const auto write = [&](const char* name, const Abscissa& abscissa) {
        chart::Chart chart = chart_of(summary, quantities[0], abscissa);
        chart.title = fmt::format("{}, {}×{}, {} runs", summary.at("scene").get<std::string>(),
                                  summary.at("width").get<int>(), summary.at("height").get<int>(),
                                  summary.at("runs").get<int>());
        chart.note = "Mean over the runs, with its 95 % band. Dotted: 1/N, as the error of independent samples falls.";
        write_file_atomically(state.path(name), chart::chart_svg(chart));
    };
    write("error-time.svg", abscissae[0]);
    write("error-samples.svg", abscissae[2]);
}

}  // namespace diptych::core
