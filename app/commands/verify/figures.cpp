#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "chart/chart.h"
#include "chart/heat_map.h"
#include "chart/number_text.h"
#include "commands/verify/report.h"
#include "error.h"
#include "image/atomic_file.h"
#include "image/figures.h"
#include "image/image_file.h"
#include "stats/multiple_testing.h"

namespace diptych::core::app {

namespace {

constexpr float untested_grey = 0.6F;
constexpr const char* untested_color = "#999999";  // the same
constexpr const char* unequal_color = "#00ffff";   // heatmap's for what is not finite

std::string png_of(const Image& image, const std::string& file) {
    const std::vector<unsigned char> bytes = png_bytes(file, image);
    return {bytes.begin(), bytes.end()};
}

/// -log10 p of each tile as a square of `side` pixels in hot colours, up to `hot`. Not finite where tiles without noise
/// differ, grey where such tiles agree.
Image tile_colors(const PairResult& pair, const TileGrid& grid, int side, float hot) {
    const auto tile_at = [&](int x, int y) -> const TileOutcome& {
        return pair.comparison.tiles[static_cast<std::size_t>(y / side * grid.columns + x / side)];
    };
    Image scores = make_image(grid.columns * side, grid.rows * side, 1);
    for (int y = 0; y < scores.height; ++y) {
        for (int x = 0; x < scores.width; ++x) {
            const TileOutcome& tile = tile_at(x, y);
            scores.at(x, y, 0) = tile.state == ChannelState::unequal
                                     ? std::nanf("")
                                     : static_cast<float>(-std::log10(std::max(tile.p, 1e-300)));
        }
    }
    Image colors = heatmap(scores, 0, hot);
    for (int y = 0; y < colors.height; ++y) {
        for (int x = 0; x < colors.width; ++x) {
            for (int channel = 0; channel < 3 && tile_at(x, y).state == ChannelState::equal; ++channel) {
                colors.at(x, y, channel) = untested_grey;
            }
        }
    }
    return colors;
}

Image bar_colors(float hot) {
    Image values = make_image(1, 256, 1);
    for (int y = 0; y < values.height; ++y) {
        values.at(0, y, 0) = hot * static_cast<float>(values.height - 1 - y) / static_cast<float>(values.height - 1);
    }
    return heatmap(values, 0, hot);
}

/// Where the two sides differ. The colours end where a single tile would fail.
std::string p_map(const PairResult& pair, const TileGrid& grid, const std::string& file) {
    const int side = std::clamp(640 / std::max(grid.columns, grid.rows), 2, 64);
    const double threshold =
        sidak_threshold(pair.alpha, static_cast<double>(std::max<std::size_t>(pair.comparison.tested, 1)));
    const float hot = static_cast<float>(std::ceil(-std::log10(threshold)));
    const Image tiles = tile_colors(pair, grid, side, hot);
    chart::HeatMap map;
    map.title = text_of(pair.names);
    map.label = "−log₁₀ p";
    map.range = {0, hot};
    map.cells = png_of(tiles, file);
    map.width = tiles.width;
    map.height = tiles.height;
    map.bar = png_of(bar_colors(hot), file);
    const auto has = [&](ChannelState state) {
        return std::any_of(pair.comparison.tiles.begin(), pair.comparison.tiles.end(),
                           [&](const TileOutcome& tile) { return tile.state == state; });
    };
    if (has(ChannelState::equal)) {
        map.keys.push_back({untested_color, "no noise, equal"});
    }
    if (has(ChannelState::unequal)) {
        map.keys.push_back({unequal_color, "no noise, different"});
    }
    return heat_map_svg(map);
}

/// How many tested tiles have a p in each of twenty classes, and the number that chance would put there.
std::string p_histogram(const PairResult& pair) {
    constexpr int bins = 20;
    chart::Series counts{"tiles", {}, chart::Shape::bars};
    for (int i = 0; i < bins; ++i) {
        counts.points.push_back({(i + 0.5) / bins, 0, chart::no_band, chart::no_band, ""});
    }
    for (const TileOutcome& tile : pair.comparison.tiles) {
        if (tile.state == ChannelState::tested) {
            counts.points[static_cast<std::size_t>(std::min(bins - 1, static_cast<int>(tile.p * bins)))].y += 1;
        }
    }
    double most = 0;
    for (chart::Point& point : counts.points) {
        most = std::max(most, point.y);
        point.note = fmt::format("p from {:.2f} to {:.2f}: {} tiles", point.x - 0.5 / bins, point.x + 0.5 / bins,
                                 static_cast<int>(point.y));
    }
    const double expected = static_cast<double>(pair.comparison.tested) / bins;
    chart::Chart chart;
    chart.title = text_of(pair.names);
    chart.x = {"p", chart::Scale::linear, chart::TickText::number, 0.0, 1.0};
    chart.y = {"tiles", chart::Scale::linear, chart::TickText::number, 0.0, std::max({1.0, 2 * expected, 1.1 * most})};
    chart.series = {counts};
    chart.marks = {{expected, "expected by chance: " + chart::figure_text(expected)}};
    chart.names = chart::Names::none;
    chart.width = 640;
    chart.height = 420;
    return chart_svg(chart);
}

}  // namespace

void prepare_folder(const std::string& folder) {
    std::error_code failure;
    std::filesystem::create_directory(folder, failure);
    if (!std::filesystem::is_directory(folder)) {
        throw Error(fmt::format("{}: is not a folder and cannot be created", folder));
    }
    check_writable(std::filesystem::path(folder) / "figure.png");
}

std::vector<std::string> write_suite_figures(const std::string& folder, const SuiteResult& suite) {
    std::vector<std::string> paths;
    const auto write = [&](const std::string& path, const std::string& svg) {
        write_file_atomically(path, svg);
        paths.push_back(path);
    };
    for (const PairResult& pair : suite.pairs) {
        std::string name = text_of(pair.names.a) + "-vs-" + text_of(pair.names.b);
        name += pair.names.frame ? fmt::format("-frame-{}", *pair.names.frame) : "";
        std::replace(name.begin(), name.end(), '/', '-');
        const std::string stem = (std::filesystem::path(folder) / name).string();
        write(stem + "-p.svg", p_map(pair, suite.grid, stem + "-p.svg"));
        write(stem + "-histogram.svg", p_histogram(pair));
    }
    return paths;
}

}  // namespace diptych::core::app
