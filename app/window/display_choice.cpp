#include "window/display_choice.h"

#include <algorithm>
#include <cmath>

namespace diptych::core::app {

namespace {

DisplayLayer layer_of(ShownLayer layer) {
    switch (layer) {
    case ShownLayer::radiance:
        return DisplayLayer::radiance;
    case ShownLayer::albedo:
        return DisplayLayer::albedo;
    case ShownLayer::normal:
        return DisplayLayer::normal;
    case ShownLayer::depth:
        return DisplayLayer::depth;
    case ShownLayer::standard_error:
        return DisplayLayer::standard_error;
    case ShownLayer::samples:
        return DisplayLayer::samples;
    case ShownLayer::light_id:
        return DisplayLayer::light_id;
    case ShownLayer::reservoir_confidence:
        return DisplayLayer::reservoir_m;
    case ShownLayer::reservoir_weight:
        return DisplayLayer::reservoir_w;
    case ShownLayer::nonfinite:
        return DisplayLayer::nonfinite;
    }
    return DisplayLayer::radiance;
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

/// From 0 to a round number that the numbers seen last stay below, however they are to be shown.
void choose_ramp(const ShownState& shown, const std::optional<DisplayRange>& seen, Legend& legend) {
    const bool difference = shown.panel == ShownPanel::difference;
    legend.shown = difference || is_scalar(layer_of(shown.layer));
    legend.difference = difference;
    legend.logarithmic = !difference && shown.layer == ShownLayer::reservoir_weight;
    legend.unit = shown.layer == ShownLayer::depth ? "m" : "";
    legend.high = shown.layer_scale > 0 ? shown.layer_scale : seen ? rounded_up(static_cast<double>(seen->high)) : 1;
    if (legend.logarithmic) {
        const double low = seen ? static_cast<double>(seen->low) : 0;
        legend.low = std::pow(10, std::floor(std::log10(std::max(low, legend.high * 1e-6))));
    }
}

}  // namespace

DisplayRequest choose_display(const ShownState& shown, const DeviceFilm& cpu, const DeviceFilm& vulkan,
                              std::uint32_t width, const std::optional<DisplayRange>& seen, Legend& legend) {
    DisplayRequest request;
    const bool both = shown.panel == ShownPanel::split || shown.panel == ShownPanel::difference;
    request.left = shown.panel == ShownPanel::vulkan ? vulkan : cpu;
    if (both) {
        request.right = vulkan;
    }
    if (shown.panel == ShownPanel::split) {
        request.divider = static_cast<std::uint32_t>(std::lround(shown.divider * width));
    }
    request.difference = shown.panel == ShownPanel::difference;
    request.layer = layer_of(shown.layer);
    request.tonemap = shown.tonemap;
    request.exposure_ev = static_cast<float>(shown.exposure);
    legend = {};
    choose_ramp(shown, seen, legend);
    request.low = static_cast<float>(legend.low);
    request.high = static_cast<float>(legend.high);
    request.logarithmic = legend.logarithmic;
    return request;
}

}  // namespace diptych::core::app
