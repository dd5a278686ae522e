#include <cmath>
#include <cstdlib>
#include <limits>

#include "catch.h"
#include "chart/chart.h"
#include "chart/heat_map.h"
#include "chart/svg.h"

using namespace diptych::core::chart;

namespace {

/// The elements of that name within the text, as they stand there.
std::vector<std::string> elements(const std::string& text, const std::string& name) {
    std::vector<std::string> found;
    for (std::size_t at = text.find("<" + name + " "); at != std::string::npos; at = text.find("<" + name + " ", at)) {
        const std::size_t end = text.find('>', at);
        found.push_back(text.substr(at, end - at));
        at = end;
    }
    return found;
}

double attribute(const std::string& element, const std::string& name) {
    const std::size_t at = element.find(" " + name + "=\"");
    REQUIRE(at != std::string::npos);
    return std::strtod(element.c_str() + at + name.size() + 3, nullptr);
}

/// From the start of the group with that class to its end.
std::string group(const std::string& svg, const std::string& name) {
    const std::size_t at = svg.find("<g class=\"" + name);
    return at == std::string::npos ? "" : svg.substr(at, svg.find("</g>", at) - at);
}

bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// The edges of the plot: those of the grid's lines.
struct Edges {
    double left, right, top, bottom;
};

Edges edges_of(const std::string& svg) {
    Edges edges{1e9, 0, 1e9, 0};
    for (const std::string& line : elements(group(svg, "grid"), "line")) {
        edges.left = std::min(edges.left, attribute(line, "x1"));
        edges.right = std::max(edges.right, attribute(line, "x2"));
        edges.top = std::min(edges.top, attribute(line, "y1"));
        edges.bottom = std::max(edges.bottom, attribute(line, "y2"));
    }
    return edges;
}

Chart log_chart() {
    Chart chart;
    chart.x = {"samples", Scale::decimal, TickText::number, 1.0, 10000.0};
    chart.y = {"error", Scale::decimal, TickText::number, 0.001, 1.0};
    return chart;
}

}  // namespace

TEST_CASE("A point lands where its values are on the axes", "[chart]") {
    Chart chart = log_chart();
    chart.series = {{"method", {{1, 1}, {10, 0.1}, {10000, 0.001}, {100, std::sqrt(0.001)}}, Shape::line}};
    const std::string svg = chart_svg(chart);
    const Edges e = edges_of(svg);
    CHECK(e.right - e.left > 500);
    CHECK(e.bottom - e.top > 300);
    const std::vector<std::string> dots = elements(svg, "circle");
    REQUIRE(dots.size() == 4);
    const double shares[][2] = {{0, 1}, {0.25, 2.0 / 3}, {1, 0}, {0.5, 0.5}};
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(attribute(dots[i], "cx") == Approx(e.left + shares[i][0] * (e.right - e.left)).margin(0.11));
        CHECK(attribute(dots[i], "cy") == Approx(e.bottom - shares[i][1] * (e.bottom - e.top)).margin(0.11));
    }
    // So are the labels of the ticks: 100 is in the middle of x.
    const std::size_t label = group(svg, "ticks").find(">100<");
    REQUIRE(label != std::string::npos);
    const std::string before = group(svg, "ticks").substr(0, label);
    CHECK(attribute(before.substr(before.rfind("<text")), "x") == Approx((e.left + e.right) / 2).margin(0.11));
}

TEST_CASE("On linear axes the range is around the points", "[chart]") {
    Chart chart;
    chart.series = {{"method", {{-2, 5}, {8, 15}}, Shape::line}};
    const std::string svg = chart_svg(chart);
    const std::vector<std::string> dots = elements(svg, "circle");
    REQUIRE(dots.size() == 2);
    CHECK(attribute(dots[0], "cx") < attribute(dots[1], "cx"));
    CHECK(attribute(dots[0], "cy") > attribute(dots[1], "cy"));
    const Edges e = edges_of(svg);
    const double tenth = (e.right - e.left) / 11;  // 5 % of air on each side
    CHECK(attribute(dots[1], "cx") - attribute(dots[0], "cx") == Approx(10 * tenth).margin(0.2));
    // A single point has a range too.
    chart.series[0].points.pop_back();
    CHECK(elements(chart_svg(chart), "circle").size() == 1);
    CHECK_FALSE(holds(chart_svg(chart), "nan"));
}

TEST_CASE("A logarithmic axis leaves out what is not above zero, and says so", "[chart]") {
    Chart chart = log_chart();
    const double infinity = std::numeric_limits<double>::infinity();
    chart.series = {{"method", {{1, 0}, {10, -0.5}, {100, 0.1}, {0, 0.1}, {20, std::nan("")}, {1000, 0.01}, {2, infinity}},
                     Shape::line}};
    std::string svg = chart_svg(chart);
    CHECK(elements(svg, "circle").size() == 2);
    CHECK(holds(svg, "Not drawn: 5 of 7 points, which are zero, negative or not finite"));
    CHECK_FALSE(holds(svg, "inf"));
    CHECK_FALSE(holds(svg, "nan"));
    chart.y.scale = Scale::linear;
    chart.y.low.reset();
    svg = chart_svg(chart);
    CHECK(elements(svg, "circle").size() == 4);
    CHECK(holds(svg, "Not drawn: 3 of 7 points"));
    chart.series[0].points = {{1, 1}, {10, 0.5}};
    CHECK_FALSE(holds(chart_svg(chart), "Not drawn"));
}

TEST_CASE("A chart with nothing to draw says so", "[chart]") {
    Chart chart = log_chart();
    CHECK(holds(chart_svg(chart), "Nothing to draw"));
    chart.series = {{"method", {{1, 0}}, Shape::line}};
    const std::string svg = chart_svg(chart);
    CHECK(holds(svg, "Nothing to draw: no value is above zero"));
    CHECK(elements(svg, "circle").empty());
}

TEST_CASE("A band that reaches zero ends at the bottom of a logarithmic axis", "[chart]") {
    Chart chart = log_chart();
    chart.series = {{"method", {{1, 0.1, 0.01, 1, ""}, {10000, 0.1, -0.2, 1, ""}}, Shape::line}};
    const std::string svg = chart_svg(chart);
    const Edges e = edges_of(svg);
    const std::size_t at = svg.find(" d=\"M") + 5;
    double x[4], y[4];
    REQUIRE(std::sscanf(svg.c_str() + at, "%lf,%lfL%lf,%lfL%lf,%lfL%lf,%lfZ", &x[0], &y[0], &x[1], &y[1], &x[2], &y[2],
                        &x[3], &y[3]) == 8);
    CHECK((x[0] == Approx(e.left) && x[1] == Approx(e.right) && x[2] == Approx(e.right) && x[3] == Approx(e.left)));
    CHECK((y[0] == Approx(e.top) && y[1] == Approx(e.top)));
    CHECK(y[2] == Approx(e.bottom));
    CHECK(y[3] == Approx(e.bottom - (e.bottom - e.top) / 3).margin(0.11));
}

TEST_CASE("Every series has its name, its colour and a place for its name alone", "[chart]") {
    Chart chart = log_chart();
    for (int i = 0; i < 30; ++i) {
        chart.series.push_back({"method " + std::to_string(i), {{1, 0.5}, {100, 0.1 + 1e-5 * i}}, Shape::line});
    }
    for (const Names names : {Names::at_ends, Names::above}) {
        chart.names = names;
        const std::string svg = chart_svg(chart);
        std::vector<std::string> labels;
        for (const std::string& label : elements(svg.substr(svg.find("<g class=\"series")), "text")) {
            labels.push_back(label);
        }
        REQUIRE(labels.size() == 30);
        for (int i = 0; i < 30; ++i) {
            CHECK(holds(svg, ">method " + std::to_string(i) + "</text>"));
            CHECK(holds(svg, "data-series=\"" + std::to_string(i) + "\" fill=\"" + series_colors()[i % 8]));
            const double x = attribute(labels[static_cast<std::size_t>(i)], "x");
            const double y = attribute(labels[static_cast<std::size_t>(i)], "y");
            CHECK(x + text_width("method 10", 13) <= chart.width);
            CHECK(y <= attribute(elements(svg, "svg")[0], "height"));
            CHECK(y >= 10);
            for (int k = 0; k < i; ++k) {
                const bool apart = std::abs(x - attribute(labels[static_cast<std::size_t>(k)], "x")) >= 60 ||
                                   std::abs(y - attribute(labels[static_cast<std::size_t>(k)], "y")) >= 17.8;
                CHECK(apart);
            }
        }
    }
    chart.names = Names::none;
    CHECK_FALSE(holds(chart_svg(chart), "method"));
}

TEST_CASE("Bars stand on the axis, as high as their values", "[chart]") {
    Chart chart;
    chart.x = {"p", Scale::linear, TickText::number, 0.0, 1.0};
    chart.y = {"tiles", Scale::linear, TickText::number, 0.0, 10.0};
    chart.series = {{"tiles", {{0.25, 10}, {0.75, 2.5}}, Shape::bars}};
    chart.marks = {{5, "expected"}};
    const std::string svg = chart_svg(chart);
    const Edges e = edges_of(svg);
    const std::vector<std::string> bars = elements(group(svg, "series"), "rect");
    REQUIRE(bars.size() == 2);
    CHECK(attribute(bars[0], "height") == Approx(e.bottom - e.top).margin(0.11));
    CHECK(attribute(bars[1], "height") == Approx((e.bottom - e.top) / 4).margin(0.11));
    CHECK(attribute(bars[1], "y") + attribute(bars[1], "height") == Approx(e.bottom).margin(0.11));
    CHECK(attribute(bars[0], "x") + attribute(bars[0], "width") < attribute(bars[1], "x"));
    const std::size_t mark = svg.find("class=\"mark\"");
    REQUIRE(mark != std::string::npos);
    CHECK(attribute(svg.substr(svg.rfind("<line", mark)), "y1") == Approx((e.top + e.bottom) / 2).margin(0.11));
    CHECK(holds(svg, ">expected</text>"));
}

TEST_CASE("The guide falls by its slope and stays within the plot", "[chart]") {
    Chart chart = log_chart();
    chart.series = {{"method", {{1, 1}, {10000, 0.001}}, Shape::line}};
    chart.guide = -0.5;
    const std::string svg = chart_svg(chart);
    const Edges e = edges_of(svg);
    const std::size_t at = svg.find("class=\"guide\"");
    REQUIRE(at != std::string::npos);
    const std::string line = svg.substr(svg.rfind("<line", at));
    const double decades_x = (attribute(line, "x2") - attribute(line, "x1")) / (e.right - e.left) * 4;
    const double decades_y = (attribute(line, "y1") - attribute(line, "y2")) / (e.bottom - e.top) * 3;
    CHECK(decades_x > 2);
    CHECK(decades_y / decades_x == Approx(-0.5).margin(0.002));
    CHECK(attribute(line, "x1") > e.left);
    CHECK(attribute(line, "x2") < e.right);
    chart.x.scale = Scale::linear;
    CHECK_FALSE(holds(chart_svg(chart), "class=\"guide\""));
}

TEST_CASE("Text is escaped, and what no XML may hold is replaced", "[chart]") {
    CHECK(xml_text("a < b && \"c\" > 'd'") == "a &lt; b &amp;&amp; &quot;c&quot; &gt; 'd'");
    CHECK(xml_text("Größe 10⁻³ 🙂\n") == "Größe 10⁻³ 🙂\n");
    CHECK(xml_text(std::string("\0\x1b[0m", 5)) == "��[0m");
    for (const char* broken : {"\x80", "\xc0\xaf", "\xe2\x82", "\xed\xa0\x80", "\xf5\x80\x80\x80", "\xef\xbf\xbf", "\xff"}) {
        const std::string text = xml_text(std::string("a") + broken + "b");
        CHECK(text.substr(0, 4) == "a�");
        CHECK(text.back() == 'b');
        CHECK(xml_text(text) == text);  // UTF-8 now
    }
    Chart chart = log_chart();
    chart.title = "<title> & \"more\"";
    chart.series = {{"a<b", {{1, 0.1, 0.05, 0.2, "x > y"}}, Shape::line}};
    const std::string svg = chart_svg(chart);
    CHECK(holds(svg, ">&lt;title&gt; &amp; &quot;more&quot;</text>"));
    CHECK(holds(svg, ">a&lt;b</text>"));
    CHECK(holds(svg, "<title>x &gt; y</title>"));
}

TEST_CASE("A long title shrinks to the width of its chart", "[chart]") {
    Chart chart = log_chart();
    chart.series = {{"method", {{1, 0.1}}, Shape::line}};
    chart.title = std::string(120, 'm');
    const std::string svg = chart_svg(chart);
    const double size = attribute(elements(svg, "text")[0], "font-size");
    CHECK(size < 16);
    CHECK(32 + text_width(chart.title, size) <= chart.width + 1);
}

TEST_CASE("A label at the end of an axis stays within the chart", "[chart]") {
    Chart chart;
    chart.names = Names::none;
    chart.series = {{"method", {{0.000098, 1}, {0.000102, 2}}, Shape::line}};
    for (const double high : {0.000102, 0.00010217, 12000000.0}) {
        chart.x = {"roughness", Scale::linear, TickText::number, 0.000098, high};
        const std::string svg = chart_svg(chart);
        for (std::size_t at = svg.find("<text"); at != std::string::npos; at = svg.find("<text", at + 1)) {
            const std::size_t begin = svg.find('>', at) + 1;
            const double width = text_width(svg.substr(begin, svg.find('<', begin) - begin), 13);
            const std::string element = svg.substr(at, begin - at);
            const double share = holds(element, "\"middle\"") ? 0.5 : holds(element, "\"end\"") ? 1 : 0;
            CHECK(attribute(element, "x") - share * width >= 0);
            CHECK(attribute(element, "x") + (1 - share) * width <= chart.width);
        }
    }
}

TEST_CASE("A heat map holds its pictures and says what their colours mean", "[chart]") {
    HeatMap map;
    map.title = "a vs b";
    map.label = "score";
    map.range = {0, 4};
    map.cells = "Man";
    map.bar = "Ma";
    map.width = 300;
    map.height = 200;
    map.keys = {{"#999999", "no noise"}};
    const std::string svg = heat_map_svg(map);
    const std::vector<std::string> images = elements(svg, "image");
    REQUIRE(images.size() == 2);
    CHECK(holds(images[0], "data:image/png;base64,TWFu\""));
    CHECK(holds(images[1], "data:image/png;base64,TWE=\""));
    CHECK(png_uri("M") == "data:image/png;base64,TQ==");
    CHECK((attribute(images[0], "width") == 300 && attribute(images[0], "height") == 200));
    const double top = attribute(images[1], "y"), height = attribute(images[1], "height");
    const std::vector<std::string> ticks = elements(svg, "line");
    REQUIRE(ticks.size() >= 3);
    CHECK(attribute(ticks.front(), "y1") == Approx(top + height));  // 0 at the bottom
    CHECK(attribute(ticks.back(), "y1") == Approx(top));
    CHECK(attribute(elements(svg, "svg")[0], "height") > top + height + 14);
    for (const char* text : {">a vs b<", ">score<", ">4<", ">no noise<"}) {
        CHECK(holds(svg, text));
    }
}
