#include "chart/number_text.h"

#include <fmt/format.h>

#include <cmath>

namespace diptych::core::chart {

namespace {

std::string superscript(int number) {
    constexpr const char* digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text;
    for (const char c : std::to_string(number)) {
        text += c == '-' ? "⁻" : digits[c - '0'];
    }
    return text;
}

/// Three digits, and all digits of a whole number.
std::string three_digits(double value) {
    return std::abs(value) >= 99.95 ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value);
}

}  // namespace

bool is_plain_number(double value) {
    const double size = std::abs(value);
    return size == 0 || (size > 0.001 * (1 - 1e-9) && size < 1e5 * (1 - 1e-9));
}

std::string plain_text(double value) {
    return fmt::format("{:.12g}", value == 0 ? 0 : value);  // 0, not -0
}

std::string power_text(double value, int digits) {
    if (value == 0) {
        return "0";
    }
    int exponent = static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-9));
    std::string factor = fmt::format("{:.{}g}", value / std::pow(10.0, exponent), digits);
    if (factor == "10" || factor == "-10") {  // 9.999 is 10 in three digits
        factor.pop_back();
        ++exponent;
    }
    if (exponent == 0) {
        return factor;
    }
    const std::string power = exponent == 1 ? "10" : "10" + superscript(exponent);
    return factor == "1" ? power : factor == "-1" ? "-" + power : factor + "·" + power;
}

std::string figure_text(double value) {
    if (!std::isfinite(value)) {
        return "–";
    }
    return is_plain_number(value) ? three_digits(value) : power_text(value, 3);
}

std::string seconds_text(double seconds) {
    if (!std::isfinite(seconds)) {
        return "–";
    }
    struct Unit {
        double seconds;
        const char* name;
    };
    for (const Unit unit : {Unit{1, "s"}, Unit{1e-3, "ms"}, Unit{1e-6, "µs"}}) {
        if (seconds >= unit.seconds * (1 - 1e-9)) {
            return three_digits(seconds / unit.seconds) + " " + unit.name;
        }
    }
    return three_digits(seconds * 1e9) + " ns";
}

std::string binary_text(double value) {
    if (value >= 1 << 20) {
        return three_digits(value / (1 << 20)) + " Mi";
    }
    return value >= 1 << 14 ? three_digits(value / 1024) + " Ki" : plain_text(value);
}

}  // namespace diptych::core::chart
