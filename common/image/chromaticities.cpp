#include "image/chromaticities.h"

#include <cmath>

namespace diptych::core {
namespace {

/// XYZ of luminance 1.
glm::dvec3 xyz_of_white(const glm::dvec2& xy) {
    return {xy.x / xy.y, 1.0, (1.0 - xy.x - xy.y) / xy.y};
}

/// One column a primary, each with X + Y + Z = 1.
glm::dmat3 primary_columns(const Chromaticities& space) {
    const auto column = [](const glm::dvec2& xy) { return glm::dvec3(xy.x, xy.y, 1.0 - xy.x - xy.y); };
    return {column(space.red), column(space.green), column(space.blue)};
}

glm::dmat3 diagonal(const glm::dvec3& d) {
    return {{d.x, 0, 0}, {0, d.y, 0}, {0, 0, d.z}};
}

/// Takes XYZ seen under one white to XYZ that looks alike under the other.
glm::dmat3 bradford(const glm::dvec2& from, const glm::dvec2& to) {
    const glm::dmat3 cones =
        glm::transpose(glm::dmat3({0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}));
    return glm::inverse(cones) * diagonal((cones * xyz_of_white(to)) / (cones * xyz_of_white(from))) * cones;
}

bool same(const glm::dvec2& a, const glm::dvec2& b) {
    return std::abs(a.x - b.x) <= 1e-4 && std::abs(a.y - b.y) <= 1e-4;
}

}  // namespace

bool same_chromaticities(const Chromaticities& a, const Chromaticities& b) {
    return same(a.red, b.red) && same(a.green, b.green) && same(a.blue, b.blue) && same(a.white, b.white);
}

bool primaries_are_xyz(const Chromaticities& space) {
    return same(space.red, {1, 0}) && same(space.green, {0, 1}) && same(space.blue, {0, 0});
}

bool is_color_space(const Chromaticities& space) {
    const double area = std::abs(glm::determinant(primary_columns(space)));
    return std::isfinite(area) && area > 1e-6 && space.white.y > 1e-6 && std::isfinite(space.white.x / space.white.y);
}

glm::dmat3 rgb_to_xyz(const Chromaticities& space) {
    const glm::dmat3 columns = primary_columns(space);
    return columns * diagonal(glm::inverse(columns) * xyz_of_white(space.white));
}

glm::dmat3 xyz_to_rec709() {
    return glm::inverse(rgb_to_xyz(rec709));
}

glm::dmat3 xyz_to_rec709(const glm::dvec2& white) {
    return xyz_to_rec709() * bradford(white, rec709.white);
}

glm::dmat3 to_rec709(const Chromaticities& space) {
    return xyz_to_rec709(space.white) * rgb_to_xyz(space);
}

void convert_color(Image& image, const glm::dmat3& matrix) {
    for (size_t i = 0; i + 2 < image.data.size(); i += 3) {
        float* pixel = image.data.data() + i;
        if (!std::isfinite(pixel[0]) || !std::isfinite(pixel[1]) || !std::isfinite(pixel[2])) {
            continue;
        }
        const glm::dvec3 converted = matrix * glm::dvec3(pixel[0], pixel[1], pixel[2]);
        for (int c = 0; c < 3; ++c) {
            pixel[c] = static_cast<float>(converted[c]);
        }
    }
}

}  // namespace diptych::core
