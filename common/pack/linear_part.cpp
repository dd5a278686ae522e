#include "pack/linear_part.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "language/compat.h"

namespace diptych::core {
namespace {

constexpr double rounding = 1e-12;
constexpr double flat = 1e-6;  // a share of the length, of fp32 vertices on a plane

double largest_entry(const glm::dmat3& m) {
    double largest = 0;
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) {
            largest = std::max(largest, std::abs(m[column][row]));
        }
    }
    return largest;
}

double frobenius(const glm::dmat3& m) {
    return std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]));
}

/// Turns columns p and q of `a` until they are orthogonal, and those of `right` with them. False where they were.
bool turn_columns(glm::dmat3& a, glm::dmat3& right, int p, int q) {
    const double pp = glm::dot(a[p], a[p]);
    const double qq = glm::dot(a[q], a[q]);
    const double pq = glm::dot(a[p], a[q]);
    if (!(std::abs(pq) > 1e-15 * std::sqrt(pp) * std::sqrt(qq))) {
        return false;
    }
    const double zeta = (qq - pp) / (2 * pq);
    const double tangent = (zeta < 0 ? -1 : 1) / (std::abs(zeta) + std::hypot(1.0, zeta));
    const double cosine = 1 / std::hypot(1.0, tangent);
    const double sine = cosine * tangent;
    for (glm::dmat3* m : {&a, &right}) {
        const glm::dvec3 from = (*m)[p];
        (*m)[p] = cosine * from - sine * (*m)[q];
        (*m)[q] = sine * from + cosine * (*m)[q];
    }
    return true;
}

glm::dvec3 any_across(const glm::dvec3& unit) {
    const glm::dvec3 axis = std::abs(unit.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    return glm::normalize(glm::cross(unit, axis));
}

}  // namespace

SingularValues singular_values(const glm::dmat3& m, bool mirrored) {
    const double scale = largest_entry(m);
    SingularValues found{glm::dmat3(1), glm::dvec3(0), glm::dmat3(1)};
    if (!(scale > 0)) {
        return found;
    }
    glm::dmat3 a = m / scale;
    glm::dmat3 right(1);
    for (int sweep = 0; sweep < 30; ++sweep) {
        const bool xy = turn_columns(a, right, 0, 1);
        const bool xz = turn_columns(a, right, 0, 2);
        const bool yz = turn_columns(a, right, 1, 2);
        if (!xy && !xz && !yz) {
            break;
        }
    }
    std::array<int, 3> order = {0, 1, 2};
    std::sort(order.begin(), order.end(), [&](int p, int q) { return glm::dot(a[p], a[p]) > glm::dot(a[q], a[q]); });
    for (int i = 0; i < 3; ++i) {
        const auto from = order[static_cast<std::size_t>(i)];
        found.values[i] = scale * glm::length(a[from]);
        found.right[i] = right[from];
    }
    found.left[0] = glm::normalize(a[order[0]]);
    const glm::dvec3 second = a[order[1]] - found.left[0] * glm::dot(found.left[0], a[order[1]]);
    const double length = glm::length(second);
    found.left[1] = length > 0 ? second / length : any_across(found.left[0]);
    const bool flips = mirrored != (glm::determinant(found.right) < 0);
    found.left[2] = glm::cross(found.left[0], found.left[1]) * (flips ? -1.0 : 1.0);
    return found;
}

bool mirrors(const glm::dmat3& m) {
    glm::dmat3 unit(m / largest_entry(m));
    for (int i = 0; i < 3; ++i) {
        unit[i] /= glm::length(unit[i]);
    }
    return glm::determinant(unit) < -rounding;
}

glm::dmat3 cofactor(const glm::dmat3& m) {
    return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

double largest_column(const glm::dmat3& m) {
    return std::max({glm::length(m[0]), glm::length(m[1]), glm::length(m[2])});
}

double least_thickness(double distance) {
    return std::clamp(std::sqrt(6e-8 * MUTANT(THICK_AS_IF_NEAR, distance, 1.0)), 2.5e-4, 2.5e-2);
}

double largest_condition(double distance) {
    return std::max(0.25 / least_thickness(distance), 25.0);
}

bool is_well_conditioned(const glm::dmat3& m, double limit) {
    const glm::dmat3 unit = m / largest_entry(m);
    const double size = frobenius(unit);
    const double volume = std::abs(glm::determinant(unit));
    // Under a condition of 1000 a volume is 2e-7 of the size cubed. Far below, cofactors and determinant are rounding.
    return volume > 1e-7 * size * size * size && size * frobenius(cofactor(unit)) < limit * volume;
}

namespace {

/// The matrix that gives the shape other singular values: `changed` of those that it has under m. `least`: of the largest, below which an
/// axis of the shape does not matter. Nothing where no area is left.
template <typename Change>
std::optional<glm::dmat3> with_values(const glm::dmat3& m, const Spread& spread, double least, const Change& changed) {
    const double longest = std::max({spread.half.x, spread.half.y, spread.half.z});
    glm::dmat3 shape(0);  // half axes in the world
    for (int i = 0; i < 3; ++i) {
        if (spread.half[i] > flat * longest) {
            shape[i] = m * (spread.axes[i] * spread.half[i]);
        }
    }
    const SingularValues s = singular_values(shape, mirrors(m));
    if (!(s.values.y > rounding * s.values.x)) {
        return std::nullopt;
    }
    const glm::dvec3 values = changed(s.values);
    if (values == s.values) {
        return m;
    }
    glm::dmat3 thick(0);
    for (int i = 0; i < 3; ++i) {
        thick += glm::outerProduct(values[i] * s.left[i], s.right[i]);
    }
    for (int i = 0; i < 3; ++i) {
        // An axis that is thin before and after may as well be wide before: the matrix is better conditioned then.
        const bool matters = glm::length(shape[i]) > least * s.values.x;
        thick[i] /= matters ? spread.half[i] : std::max(spread.half[i], least * longest);
    }
    return thick * glm::transpose(spread.axes);
}

}  // namespace

std::optional<glm::dmat3> thickened(const glm::dmat3& m, const Spread& spread, double thickness) {
    return with_values(m, spread, thickness,
                       [&](const glm::dvec3& v) { return glm::max(v, glm::dvec3(thickness * v.x)); });
}

std::optional<glm::dmat3> with_sheets_apart(const glm::dmat3& m, const Spread& spread) {
    return with_values(m, spread, least_gap, [](const glm::dvec3& v) {
        return glm::dvec3(v.x, v.y, std::max(v.z, std::min(least_gap * v.x, v.y)));
    });
}

}  // namespace diptych::core
