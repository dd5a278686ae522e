// Colour spaces by their primaries and white points, and the way from them to linear Rec.709.
#pragma once

#include <glm/glm.hpp>

#include "image/image.h"

namespace diptych::core {

/// CIE 1931 x, y of the primaries and of white, which is RGB (1, 1, 1).
struct Chromaticities {
    glm::dvec2 red;
    glm::dvec2 green;
    glm::dvec2 blue;
    glm::dvec2 white;
};

/// ITU-R BT.709-6, table 1, items 1.3 and 1.4; its white is D65.
inline constexpr Chromaticities rec709 = {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}};

/// Whether both agree to 1e-4, a unit of the last digit that standards give.
bool same_chromaticities(const Chromaticities& a, const Chromaticities& b);

/// Whether the primaries are those of CIE XYZ itself, whatever the white point.
bool primaries_are_xyz(const Chromaticities& space);

/// Whether the primaries span a colour space and its white has a luminance: else the functions below divide by zero.
bool is_color_space(const Chromaticities& space);

/// From RGB to CIE XYZ, where white has Y = 1 (SMPTE RP 177-1993, section 3.3).
glm::dmat3 rgb_to_xyz(const Chromaticities& space);

/// From the RGB of a space to linear Rec.709. The space's white becomes Rec.709's white: chromatic adaptation by the
/// Bradford matrix (Lam 1985), as in ICC.1:2022, annex E.
glm::dmat3 to_rec709(const Chromaticities& space);

/// From CIE XYZ to linear Rec.709. Where a white point is given, it becomes Rec.709's white as above.
glm::dmat3 xyz_to_rec709();
glm::dmat3 xyz_to_rec709(const glm::dvec2& white);

/// Multiplies every pixel of three channels. A pixel that is not finite stays as it is, so that what was wrong with it
/// can still be said.
void convert_color(Image& image, const glm::dmat3& matrix);

}  // namespace diptych::core
