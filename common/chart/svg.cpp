#include "chart/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace diptych::core::chart {

namespace {

/// Bytes of the UTF-8 character at the front of the text; 0 where they are none, or a surrogate's.
std::size_t character_size(std::string_view text) {
    const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
    const unsigned lead = byte(0);
    const std::size_t size = lead < 0x80 ? 1 : lead >= 0xC2 && lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
    if ((lead >= 0x80 && lead < 0xC2) || lead > 0xF4 || size > text.size()) {
        return 0;
    }
    for (std::size_t i = 1; i < size; ++i) {
        if ((byte(i) & 0xC0U) != 0x80) {
            return 0;
        }
    }
    const bool overlong = (lead == 0xE0 && byte(1) < 0xA0) || (lead == 0xF0 && byte(1) < 0x90);
    const bool beyond = (lead == 0xED && byte(1) >= 0xA0) || (lead == 0xF4 && byte(1) >= 0x90);
    const bool unassigned = lead == 0xEF && byte(1) == 0xBF && byte(2) >= 0xBE;  // U+FFFE and U+FFFF
    return overlong || beyond || unassigned ? 0 : size;
}

}  // namespace

std::string xml_text(std::string_view text) {
    std::string safe;
    while (!text.empty()) {
        const std::size_t size = character_size(text);
        const char c = text[0];
        const bool control = size == 1 && ((c < ' ' && c != '\t' && c != '\n' && c != '\r') || c == '\x7f');
        if (size == 0 || control) {
            safe += "\uFFFD";
        } else if (c == '<') {
            safe += "&lt;";
        } else if (c == '>') {
            safe += "&gt;";
        } else if (c == '&') {
            safe += "&amp;";
        } else if (c == '"') {
            safe += "&quot;";
        } else {
            safe += text.substr(0, size);
        }
        text.remove_prefix(std::max<std::size_t>(size, 1));
    }
    return safe;
}

double text_width(std::string_view text, double size) {
    const auto characters = std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; });
    return 0.61 * size * static_cast<double>(characters);
}

std::string svg_line(Point2 from, Point2 to, std::string_view attributes) {
    return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", from.x, from.y, to.x,
                       to.y, attributes);
}

std::string svg_label(Point2 at, std::string_view anchor, std::string_view text, std::string_view attributes) {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" {}>{}</text>\n", at.x, at.y, anchor,
                       attributes, xml_text(text));
}

std::string svg_title(std::string_view text, double document_width) {
    const double room = document_width - 32;
    const double needed = text_width(text, 16);
    const double size = room > 0 && needed > room ? 16 * room / needed : 16;
    return svg_label({16, 27}, "start", text,
                     fmt::format("class=\"title\" fill=\"#1d1f24\" font-size=\"{:.1f}\" font-weight=\"600\"", size));
}

std::string png_uri(std::string_view png) {
    constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text = "data:image/png;base64,";
    text.reserve(text.size() + png.size() / 3 * 4 + 4);
    for (std::size_t i = 0; i < png.size(); i += 3) {
        std::uint32_t group = 0;
        const std::size_t count = std::min<std::size_t>(3, png.size() - i);
        for (std::size_t k = 0; k < 3; ++k) {
            group = group << 8U | (k < count ? static_cast<unsigned char>(png[i + k]) : 0U);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            text += k <= count ? digits[group >> (18 - 6 * k) & 63U] : '=';
        }
    }
    return text;
}

std::string svg_document(double width, double height, std::string_view name, std::string_view content) {
    return fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
                       "height=\"{1:.0f}\" role=\"img\" aria-label=\"{2}\" fill=\"#4a505a\" font-size=\"13\" "
                       "font-family=\"system-ui, 'DejaVu Sans', Arial, sans-serif\">\n"
                       "<rect class=\"paper\" width=\"{0:.0f}\" height=\"{1:.0f}\" fill=\"#ffffff\"/>\n{3}</svg>\n",
                       width, height, xml_text(name), content);
}

}  // namespace diptych::core::chart
