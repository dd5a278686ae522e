#include "image/radiance_header.h"

#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace diptych::core {
namespace {

[[noreturn]] void refuse(const std::string& reason) {
    throw std::runtime_error(reason);
}

/// Long lines and control characters would spoil the one line of an error.
std::string quoted(std::string_view line) {
    std::string text;
    for (const char c : line.substr(0, 60)) {
        text += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
    }
    return "'" + text + (line.size() > 60 ? "…'" : "'");
}

/// Takes one line off the front of the rest.
std::string_view next_line(std::string_view bytes, size_t& at) {
    const size_t end = bytes.find('\n', at);
    if (end == std::string_view::npos) {
        refuse("the header has no end");
    }
    std::string_view line = bytes.substr(at, end - at);
    at = end + 1;
    if (!line.empty() && line.back() == '\r') {
        line.remove_suffix(1);
    }
    return line;
}

std::vector<double> numbers(std::string_view line, std::string_view text, size_t count) {
    std::istringstream stream{std::string(text)};
    stream.imbue(std::locale::classic());
    std::vector<double> values(count);
    for (double& value : values) {
        if (!(stream >> value) || !std::isfinite(value)) {
            refuse("the header's line " + quoted(line) + " wants " + std::to_string(count) + " numbers");
        }
    }
    return values;
}

double factor(std::string_view line, double value) {
    if (!(value > 0)) {
        refuse("the header's line " + quoted(line) + " divides by a value that is not positive");
    }
    return value;
}

bool read_format(std::string_view line, std::string_view value) {
    const size_t begin = value.find_first_not_of(" \t");
    const size_t end = value.find_last_not_of(" \t");
    value = begin == std::string_view::npos ? "" : value.substr(begin, end - begin + 1);
    if (value != "32-bit_rle_rgbe" && value != "32-bit_rle_xyze") {
        refuse("the header's line " + quoted(line) + " is neither FORMAT=32-bit_rle_rgbe nor FORMAT=32-bit_rle_xyze");
    }
    return value == "32-bit_rle_xyze";
}

/// Nothing where all are 0, which common writers put for primaries that they do not know.
std::optional<Chromaticities> read_primaries(std::string_view line, std::string_view text) {
    const std::vector<double> v = numbers(line, text, 8);
    if (std::all_of(v.begin(), v.end(), [](double value) { return value == 0; })) {
        return std::nullopt;
    }
    const Chromaticities space{{v[0], v[1]}, {v[2], v[3]}, {v[4], v[5]}, {v[6], v[7]}};
    if (!is_color_space(space)) {
        refuse("the header's line " + quoted(line) + " spans no colour space");
    }
    return space;
}

void read_resolution(std::string_view line, RadianceHeader& header) {
    std::istringstream stream{std::string(line)};
    for (RadianceAxis* axis : {&header.scanlines, &header.pixels}) {
        std::string direction;
        long long size = 0;
        const bool whole = static_cast<bool>(stream >> direction >> size) && direction.size() == 2 && size >= 1 &&
                           size <= 0x7fffffff && (direction[0] == '+' || direction[0] == '-') &&
                           (direction[1] == 'X' || direction[1] == 'Y');
        if (!whole) {
            refuse("the resolution line " + quoted(line) + " is not of the kind '-Y 512 +X 1024'");
        }
        axis->vertical = direction[1] == 'Y';
        axis->reversed = axis->vertical == (direction[0] == '+');  // +Y points upwards, and the top row is row 0
        axis->size = static_cast<int>(size);
    }
    if (header.scanlines.vertical == header.pixels.vertical) {
        refuse("the resolution line " + quoted(line) + " names one axis twice");
    }
}

}  // namespace

RadianceHeader read_radiance_header(std::string_view bytes) {
    RadianceHeader header;
    if (bytes.substr(0, 2) != "#?") {
        refuse("a Radiance picture begins with #?, and this file does not");
    }
    bool has_format = false;
    size_t at = 0;
    for (std::string_view line = next_line(bytes, at); !line.empty(); line = next_line(bytes, at)) {
        const auto value_of = [&](std::string_view key, std::string_view& value) {
            if (line.substr(0, key.size()) != key) {
                return false;
            }
            value = line.substr(key.size());
            return true;
        };
        std::string_view value;
        if (value_of("FORMAT=", value)) {
            header.xyz = read_format(line, value);
            has_format = true;
        } else if (value_of("EXPOSURE=", value)) {
            header.multiplied *= factor(line, numbers(line, value, 1)[0]);
        } else if (value_of("COLORCORR=", value)) {
            const std::vector<double> v = numbers(line, value, 3);
            header.multiplied *= glm::dvec3(factor(line, v[0]), factor(line, v[1]), factor(line, v[2]));
        } else if (value_of("PRIMARIES=", value)) {
            header.primaries = read_primaries(line, value);
        } else if (value_of("GAMMA=", value) && numbers(line, value, 1)[0] != 1) {
            refuse("the header's line " + quoted(line) + " says that the pixels are display values, not radiance");
        }
    }
    if (!has_format) {
        refuse("the header has no FORMAT line");
    }
    read_resolution(next_line(bytes, at), header);
    header.size = at;
    return header;
}

}  // namespace diptych::core
