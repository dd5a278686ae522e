// The header of a Radiance picture (.hdr): what its bytes mean and in which order they come.
#pragma once

#include <optional>
#include <string_view>

#include "image/chromaticities.h"

namespace diptych::core {

/// One axis of the resolution line.
struct RadianceAxis {
    bool vertical = false;
    bool reversed = false;  // from the right, or from the bottom
    int size = 0;

    /// Column from the left, or row from the top, of the i-th place along the axis.
    int place(int i) const { return reversed ? size - 1 - i : i; }
};

struct RadianceHeader {
    bool xyz = false;            // pixels are CIE XYZ, not RGB
    glm::dvec3 multiplied{1.0};  // what the pixels were multiplied by: the product of all EXPOSURE and COLORCORR lines
    std::optional<Chromaticities> primaries;
    RadianceAxis scanlines;  // from one scanline to the next
    RadianceAxis pixels;     // along a scanline
    size_t size = 0;         // bytes of the header

    int width() const { return scanlines.vertical ? pixels.size : scanlines.size; }
    int height() const { return scanlines.vertical ? scanlines.size : pixels.size; }
};

/// Reads the header as G. Ward, 'The RADIANCE Picture File Format' (Real Pixels, Graphics Gems II, and filefmts.pdf of
/// the Radiance distribution) says. Throws a std::runtime_error that says what is wrong, without the file's name.
RadianceHeader read_radiance_header(std::string_view bytes);

}  // namespace diptych::core
