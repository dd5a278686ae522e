#include "window/display_choice.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "render/film_statistics.h"

namespace diptych::app {

namespace {

DisplayLayer layer_of(ShownLayer layer) {
    switch (layer) {
        case ShownLayer::radiance: return DisplayLayer::radiance;
        case ShownLayer::albedo: return DisplayLayer::albedo;
        case ShownLayer::normal: return DisplayLayer::normal;
        case ShownLayer::depth: return DisplayLayer::depth;
        case ShownLayer::standard_error: return DisplayLayer::standard_error;
        case ShownLayer::samples: return DisplayLayer::samples;
        case ShownLayer::light_id: return DisplayLayer::light_id;
        case ShownLayer::reservoir_confidence: return DisplayLayer::reservoir_m;
        case ShownLayer::reservoir_weight: return DisplayLayer::reservoir_w;
        case ShownLayer::nonfinite: return DisplayLayer::nonfinite;
    }
    return DisplayLayer::radiance;
}

double luminance_of(const Rgb& color) {
    return 0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2];
}

/// The value that 98 of 100 of some thousand pixels do not pass; 0 where none is known.
double high_percentile(std::size_t pixels, const std::function<double(std::size_t)>& value) {
    std::vector<double> values;
    for (std::size_t i = 0; i < pixels; i += std::max<std::size_t>(pixels / 4096, 1)) {
        const double v = value(i);
        if (std::isfinite(v) && v > 0) {
            values.push_back(v);
        }
    }
    if (values.empty()) {
        return 0;
    }
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 98 / 100);
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

/// Two digits of 1, 2, 5, so that the legend is round and stands still while samples come.
double rounded_up(double value) {
    if (!(value > 0)) {
        return 1;
    }
    const double decade = std::pow(10, std::floor(std::log10(value)));
    for (const double step : {1.0, 2.0, 5.0}) {
        if (value <= step * decade * (1 + 1e-9)) {
            return step * decade;
        }
    }
    return 10 * decade;
}

double found_high(ShownLayer layer, const Film& film) {
    const std::size_t pixels = film.pixels.size();
    switch (layer) {
        case ShownLayer::depth:
            return film.first_hits.empty() ? 0
                                           : high_percentile(pixels, [&](std::size_t i) { return static_cast<double>(film.first_hits[i].depth); });
        case ShownLayer::standard_error:
            return film.moments.empty() ? 0 : high_percentile(pixels, [&](std::size_t i) {
                return luminance_of(pixel_standard_error(film.pixels[i], film.moments[i]));
            });
        case ShownLayer::samples:
            return high_percentile(pixels, [&](std::size_t i) { return static_cast<double>(film.pixels[i].samples); });
        default:
            return 0;
    }
}

double found_difference(const Film& film) {
    return high_percentile(film.pixels.size(), [&](std::size_t i) { return luminance_of(pixel_mean(film.pixels[i])); }) / 4;
}

void choose_ramp(const ShownState& shown, const PanelShot* shot, Legend& legend) {
    const Film* film = shot != nullptr ? shot->film.get() : nullptr;
    const bool difference = shown.panel == ShownPanel::difference;
    legend.shown = difference || is_scalar(layer_of(shown.layer));
    legend.difference = difference;
    legend.unit = shown.layer == ShownLayer::depth ? "m" : "";
    if (shown.layer_scale > 0) {
        legend.high = shown.layer_scale;
    } else if (difference && !is_scalar(layer_of(shown.layer))) {
        legend.high = film != nullptr ? rounded_up(found_difference(*film)) : 1;
    } else if (shown.layer == ShownLayer::reservoir_confidence) {
        const ResamplingSettings none;
        legend.high = 1 + static_cast<double>(shot != nullptr ? shot->state.request.settings.resampling.confidence_cap : none.confidence_cap);
    } else if (shown.layer == ShownLayer::reservoir_weight) {
        legend.low = 1e-3;
        legend.high = 1e3;
        legend.logarithmic = true;
    } else {
        legend.high = film != nullptr ? rounded_up(found_high(shown.layer, *film)) : 1;
    }
}

}  // namespace

DisplayRequest choose_display(const ShownState& shown, const PanelFilm& cpu, const PanelFilm& vulkan, std::uint32_t width, Legend& legend) {
    DisplayRequest request;
    const bool both = shown.panel == ShownPanel::split || shown.panel == ShownPanel::difference;
    const PanelFilm& first = shown.panel == ShownPanel::vulkan ? vulkan : cpu;
    request.left = first.device;
    if (both) {
        request.right = vulkan.device;
    }
    if (shown.panel == ShownPanel::split) {
        request.divider = static_cast<std::uint32_t>(std::lround(shown.divider * width));
    }
    request.difference = shown.panel == ShownPanel::difference;
    request.layer = layer_of(shown.layer);
    request.tonemap = shown.tonemap;
    request.exposure_ev = static_cast<float>(shown.exposure);
    legend = {};
    choose_ramp(shown, first.shot.get(), legend);
    request.low = static_cast<float>(legend.low);
    request.high = static_cast<float>(legend.high);
    request.logarithmic = legend.logarithmic;
    return request;
}

}  // namespace diptych::app
