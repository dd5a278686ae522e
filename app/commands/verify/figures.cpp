#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "error.h"
#include "image/figures.h"
#include "image/image_file.h"
#include "image/raster_text.h"
#include "stats/multiple_testing.h"
#include "commands/verify/report.h"

namespace diptych::core::app {

namespace {

constexpr int margin = 16;
constexpr int text_scale = 3;
constexpr int line_height = 7 * text_scale;
constexpr float ink = 0;
constexpr float untested = 0.6F;

void paste(Image& target, const Image& source, int x, int y) {
    for (int row = 0; row < source.height; ++row) {
        std::copy_n(source.data.begin() + static_cast<std::ptrdiff_t>(source.index(0, row, 0)),
                    source.width * source.channels,
                    target.data.begin() + static_cast<std::ptrdiff_t>(target.index(x, y + row, 0)));
    }
}

/// -log10 p in hot colours, up to where a single tile would fail; cyan where tiles without noise differ, grey where
/// they agree.
Image p_map(const PairResult& pair, const TileGrid& grid) {
    const int side = std::clamp(640 / std::max(grid.columns, grid.rows), 2, 64);
    const double threshold =
        sidak_threshold(pair.alpha, static_cast<double>(std::max<std::size_t>(pair.comparison.tested, 1)));
    const float hot = static_cast<float>(std::ceil(-std::log10(threshold)));
    Image scores = make_image(grid.columns * side, grid.rows * side, 1);
    for (int y = 0; y < scores.height; ++y) {
        for (int x = 0; x < scores.width; ++x) {
            const TileOutcome& tile =
                pair.comparison.tiles[static_cast<std::size_t>(y / side * grid.columns + x / side)];
            scores.at(x, y, 0) = tile.state == ChannelState::unequal
                                     ? std::nanf("")
                                     : static_cast<float>(-std::log10(std::max(tile.p, 1e-300)));
        }
    }
    Image map = heatmap(scores, 0, hot);
    for (int row = 0; row < grid.rows; ++row) {
        for (int column = 0; column < grid.columns; ++column) {
            if (pair.comparison.tiles[static_cast<std::size_t>(row * grid.columns + column)].state ==
                ChannelState::equal) {
                draw_rectangle(map, column * side, row * side, side, side, untested);
            }
        }
    }
    constexpr int bar_width = 24;
    const int bar_height = std::max(map.height, 8 * line_height);
    Image bar = make_image(bar_width, bar_height, 1);
    for (int y = 0; y < bar.height; ++y) {
        for (int x = 0; x < bar.width; ++x) {
            bar.at(x, y, 0) = hot * static_cast<float>(bar.height - 1 - y) / static_cast<float>(bar.height - 1);
        }
    }
    const std::string title = text_of(pair.names);
    const std::string label = "-log10 p";
    const int width =
        std::max(map.width + bar_width + 3 * margin + text_width("000", text_scale), text_width(title, text_scale)) +
        margin;
    Image figure = make_image(std::max(width, map.width + 3 * margin + text_width(label, text_scale)),
                              bar_height + 2 * line_height + 2 * margin, 3, 1);
    draw_text(figure, margin, margin, title, text_scale, ink);
    const int top = margin + 2 * line_height;
    const int bar_left = map.width + 2 * margin;
    draw_text(figure, bar_left, margin + line_height, label, text_scale, ink);
    paste(figure, map, margin, top);
    paste(figure, heatmap(bar, 0, hot), bar_left, top);
    const int step = std::max(1, static_cast<int>(hot) / 6);
    for (int value = 0; value <= static_cast<int>(hot); value += step) {
        const int y =
            top +
            static_cast<int>(std::lround((1 - static_cast<float>(value) / hot) * static_cast<float>(bar_height - 1)));
        draw_rectangle(figure, bar_left + bar_width, y - 1, 6, 2, ink);
        draw_text(figure, bar_left + bar_width + 10, std::clamp(y - 7, top, top + bar_height - 15),
                  std::to_string(value), text_scale, ink);
    }
    return figure;
}

/// How many tested tiles have a p in each of twenty classes, and the number that chance would put there.
Image p_histogram(const PairResult& pair) {
    constexpr int bins = 20;
    constexpr int bar = 28;
    constexpr int height = 320;
    std::array<double, bins> counts{};
    for (const TileOutcome& tile : pair.comparison.tiles) {
        if (tile.state == ChannelState::tested) {
            counts[static_cast<std::size_t>(std::min(bins - 1, static_cast<int>(tile.p * bins)))] += 1;
        }
    }
    const double expected = static_cast<double>(pair.comparison.tested) / bins;
    const double most = std::max({1.0, 2 * expected, *std::max_element(counts.begin(), counts.end())});
    const auto level = [&](double count) { return static_cast<int>(std::lround(count / most * height)); };
    const std::string highest = fmt::format("{:.3g}", most);
    const std::string title = text_of(pair.names);
    const int left =
        2 * margin + std::max(text_width(highest, text_scale), text_width(fmt::format("{:.3g}", expected), text_scale));
    const int top = margin + 2 * line_height;
    const int bottom = top + height;
    Image figure = make_image(std::max(left + bins * bar, margin + text_width(title, text_scale)) + 2 * margin,
                              bottom + 2 * line_height + margin, 3, 1);
    draw_text(figure, margin, margin, title, text_scale, ink);
    for (int i = 0; i < bins; ++i) {
        const int tall = level(counts[static_cast<std::size_t>(i)]);
        draw_rectangle(figure, left + i * bar + 2, bottom - tall, bar - 4, tall, 0.45F);
    }
    for (int x = 0; x < bins * bar; x += 8) {
        draw_rectangle(figure, left + x, bottom - level(expected), 4, 2, ink);
    }
    draw_rectangle(figure, left, bottom, bins * bar, 2, ink);
    draw_rectangle(figure, left, top, 2, height, ink);
    draw_text(figure, margin, top, highest, text_scale, ink);
    if (level(expected) > 0) {
        draw_text(figure, margin, bottom - level(expected) - 7, fmt::format("{:.3g}", expected), text_scale, ink);
    }
    for (const auto& [p, text] : {std::pair{0.0, "0"}, {0.5, "0.5"}, {1.0, "1"}}) {
        const int x = left + static_cast<int>(p * bins * bar);
        draw_rectangle(figure, x, bottom, 2, 8, ink);
        draw_text(figure, x - text_width(text, text_scale) / 2, bottom + 12, text, text_scale, ink);
    }
    draw_text(figure, left + bins * bar / 4 - text_width("p", text_scale) / 2, bottom + 12, "p", text_scale, ink);
    return figure;
}

}  // namespace

void prepare_folder(const std::string& folder) {
    std::error_code failure;
    std::filesystem::create_directory(folder, failure);
    if (!std::filesystem::is_directory(folder)) {
        throw Error(fmt::format("{}: is no folder, and cannot be made one", folder));
    }
    check_writable(std::filesystem::path(folder) / "figure.png");
}

std::vector<std::string> write_suite_figures(const std::string& folder, const SuiteResult& suite) {
    std::vector<std::string> paths;
    for (const PairResult& pair : suite.pairs) {
        std::string name = text_of(pair.names.a) + "-vs-" + text_of(pair.names.b);
        name += pair.names.frame ? fmt::format("-frame-{}", *pair.names.frame) : "";
        std::replace(name.begin(), name.end(), '/', '-');
        const std::string stem = (std::filesystem::path(folder) / name).string();
        paths.push_back(stem + "-p.png");
        write_png(paths.back(), p_map(pair, suite.grid));
        paths.push_back(stem + "-histogram.png");
        write_png(paths.back(), p_histogram(pair));
    }
    return paths;
}

}  // namespace diptych::core::app
