#include "measure/converge/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "chart/svg.h"
#include "measure/converge/charts.h"
#include "image/atomic_file.h"
#include "input_file.h"
#include "measure/converge/method.h"
#include "page_texts.h"

namespace diptych::core {

namespace {

/// A PNG as a data URI; null where there is none.
nlohmann::ordered_json embedded(const std::string& path) {
    if (!std::filesystem::exists(path)) {
        return nullptr;
    }
    require_input(path);
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    return chart::png_uri(bytes);
}

/// JSON that a script element can hold: no "</" ends it early.
std::string script_text(const nlohmann::ordered_json& json) {
    std::string text;
    for (const char c : json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)) {
        text += c == '<' ? std::string("\\u003c") : std::string(1, c);
    }
    return text;
}

/// What a chart needs of the numbers: six digits.
nlohmann::ordered_json rounded(nlohmann::ordered_json json) {
    if (json.is_number_float()) {
        const double value = json;
        return std::isfinite(value) ? nlohmann::ordered_json(std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr))
                                    : nullptr;
    }
    if (json.is_structured()) {
        for (auto& value : json) {
            value = rounded(value);
        }
    }
    return json;
}

/// Every chart twice: for wide windows with the names at the lines' ends, and for narrow ones, which have the names below.
std::string charts_html(const nlohmann::ordered_json& summary) {
    std::string html;
    for (ErrorChart& chart : error_charts(summary)) {
        html += fmt::format("<figure class=\"chart\" data-what=\"{}\" data-over=\"{}\"{}>\n",
                            chart::xml_text(chart.what), chart::xml_text(chart.over), html.empty() ? "" : " hidden");
        chart.chart.width = 1100;
        chart.chart.height = 560;
        html += "<div class=\"wide\">" + chart_svg(chart.chart) + "</div>\n";
        chart.chart.width = 350;
        chart.chart.height = 320;
        chart.chart.names = chart::Names::none;
        html += "<div class=\"narrow\">" + chart_svg(chart.chart) + "</div>\n";
        html += "<figcaption class=\"note\">" + chart::xml_text(chart.note) + "</figcaption>\n</figure>\n";
    }
    return html;
}

/// The colours of the series for the style sheet, as custom properties c0, c1, …
std::string color_variables() {
    const std::string custom(2, '-');  // begins their names
    std::string css;
    for (const std::string& color : chart::series_colors()) {
        css += fmt::format("{}c{}: {}; ", custom, std::count(css.begin(), css.end(), ';'), color);
    }
    return ":root { " + css + "}\n";
}

/// The template with each {{NAME}} replaced, in one pass: what is put in is not looked at again.
std::string filled(std::string_view page, const std::map<std::string, std::string>& values) {
    std::string text;
    for (std::size_t at = 0;;) {
        const std::size_t open = page.find("{{", at);
        if (open == std::string_view::npos) {
            return text.append(page.substr(at));
        }
        const std::size_t close = page.find("}}", open);
        text.append(page.substr(at, open - at)).append(values.at(std::string(page.substr(open + 2, close - open - 2))));
        at = close + 2;
    }
}

}  // namespace

std::string page_html(const nlohmann::ordered_json& summary, const ConvergeState& state) {
    nlohmann::ordered_json pictures = {{"reference", {{"picture", embedded(state.path("pictures/reference.png"))}}}};
    for (const auto& method : summary.at("methods")) {
        const std::string stem = "pictures/" + file_stem(method.at("method"));
        pictures[method.at("method").get<std::string>()] = {{"picture", embedded(state.path(stem + ".png"))},
                                                            {"error", embedded(state.path(stem + "-error.png"))}};
    }
    const std::string scene = summary.at("scene");
    const std::string name =
        scene.substr(scene.find_last_of('/') == std::string::npos ? 0 : scene.find_last_of('/') + 1);
    return filled(page_text("page.html"), {{"TITLE", chart::xml_text(name)},
                                           {"STYLE", color_variables() + std::string(page_text("page.css"))},
                                           {"CHARTS", charts_html(summary)},
                                           {"DATA", script_text(rounded(summary))},
                                           {"PICTURES", script_text(pictures)},
                                           {"CHART", std::string(page_text("chart.js"))},
                                           {"VIEWER", std::string(page_text("viewer.js"))},
                                           {"SCRIPT", std::string(page_text("page.js"))}});
}

void write_page(const nlohmann::ordered_json& summary, const ConvergeState& state) {
    write_file_atomically(state.path("index.html"), page_html(summary, state));
}

}  // namespace diptych::core
