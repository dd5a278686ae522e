#include "chart/axis.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "chart/number_text.h"

namespace diptych::core::chart {

namespace {

constexpr double slack = 1e-9;  // of a step, by which a tick may lie beyond the range: rounding moves ticks at the ends

struct Value {
    double value;
    bool labelled;
};

/// Multiples of 1, 2 or 5 times a power of ten: of the finest of these steps that has at most `most` values.
std::vector<Value> even_values(const Range& range, int most) {
    const double least = (range.high - range.low) / (most + 1);
    for (double power = std::pow(10.0, std::floor(std::log10(least)));; power *= 10) {
        for (const double step : {power, 2 * power, 5 * power}) {
            const double first = std::ceil(range.low / step - slack);
            const double last = std::floor(range.high / step + slack);
            if (last - first < most) {
                std::vector<Value> values;
                for (double i = first; i <= last; ++i) {
                    values.push_back({i * step, true});
                }
                return values;
            }
        }
    }
}

/// Powers of `base` times each factor. Labels go to all, else to the powers, else to every k-th power. Powers are
/// counted from 1, so that a label stands at 1 if the range holds it.
std::vector<Value> log_values(const Range& range, int most, double base, const std::vector<double>& factors) {
    const double logarithm = std::log(base);
    const int first = static_cast<int>(std::floor(std::log(range.low) / logarithm));
    const int last = static_cast<int>(std::ceil(std::log(range.high) / logarithm));
    const auto inside = [&](double value) {
        return value >= range.low * (1 - slack) && value <= range.high * (1 + slack);
    };
    int all = 0;
    int powers = 0;
    for (int e = first; e <= last; ++e) {
        for (const double factor : factors) {
            all += inside(factor * std::pow(base, e)) ? 1 : 0;
        }
        powers += inside(std::pow(base, e)) ? 1 : 0;
    }
    const int every = std::max(1, (powers + most - 1) / most);
    std::vector<Value> values;
    for (int e = first; e <= last; ++e) {
        for (const double factor : factors) {
            const double value = factor * std::pow(base, e);
            if (inside(value)) {
                values.push_back({value, all <= most || (factor == 1 && e % every == 0)});
            }
        }
    }
    return values;
}

std::vector<Value> values_of(Scale scale, const Range& range, int most) {
    if (scale == Scale::linear) {
        return even_values(range, most);
    }
    std::vector<Value> values =
        scale == Scale::binary ? log_values(range, most, 2, {1}) : log_values(range, most, 10, {1, 2, 5});
    const auto labelled = std::count_if(values.begin(), values.end(), [](const Value& v) { return v.labelled; });
    // A short range holds a single value of 1, 2 and 5, or none, and a single label gives no scale.
    return labelled < 2 && range.high < 10 * range.low ? even_values(range, most) : values;
}

}  // namespace

bool is_logarithmic(Scale scale) {
    return scale != Scale::linear;
}

bool can_show(Scale scale, double value) {
    return std::isfinite(value) && (value > 0 || !is_logarithmic(scale));
}

double share_of(Scale scale, const Range& range, double value) {
    if (!is_logarithmic(scale)) {
        return std::clamp((value - range.low) / (range.high - range.low), 0.0, 1.0);
    }
    if (!(value > range.low)) {
        return 0;
    }
    return std::clamp(std::log(value / range.low) / std::log(range.high / range.low), 0.0, 1.0);
}

std::vector<Tick> axis_ticks(Scale scale, const Range& range, int most, TickText text) {
    const std::vector<Value> values = values_of(scale, range, most);
    // One axis writes all its numbers alike: 0.01 and 10⁻⁵ side by side are hard to compare.
    const bool plain = std::all_of(values.begin(), values.end(),
                                   [](const Value& v) { return !v.labelled || is_plain_number(v.value); });
    std::vector<Tick> ticks;
    for (const Value& v : values) {
        Tick tick{v.value, ""};
        if (v.labelled) {
            tick.text = text == TickText::seconds ? seconds_text(v.value)
                        : scale == Scale::binary  ? binary_text(v.value)
                        : plain                   ? plain_text(v.value)
                                                  : power_text(v.value);
        }
        ticks.push_back(tick);
    }
    return ticks;
}

}  // namespace diptych::core::chart
