// What a transform's linear part does to shapes, however near it is to having no inverse.
#pragma once

#include <glm/glm.hpp>
#include <optional>

namespace diptych::core {

/// m = left · diag(values) · transpose(right), both orthogonal, values from the largest to the smallest.
struct SingularValues {
    glm::dmat3 left;
    glm::dvec3 values;
    glm::dmat3 right;
};

/// By rotations from the right (Hestenes 1958), which keep the digits of small values. Where a value is 0, the left
/// vector completes the others; the last one so that the product mirrors as told.
SingularValues singular_values(const glm::dmat3& m, bool mirrored);

/// Whether it turns right hands into left ones. A determinant that is rounding, 1e-12 of the columns' lengths, does
/// not: its sign says nothing about the file.
bool mirrors(const glm::dmat3& m);

/// The matrix that carries normals: the inverse transpose times the determinant. It exists for every matrix.
glm::dmat3 cofactor(const glm::dmat3& m);

/// The length of the longest column: at most the largest singular value, and at least 0.57 of it.
double largest_column(const glm::dmat3& m);

/// What the thickness of a shape becomes under a matrix without a good inverse, as a share of its size, where it is `distance`
/// of its sizes away from the eye. Rays in fp32 that start there miss its silhouette by 6e-8 k distance of its size, where k is
/// the matrix's condition. A flattened shape's k is 1 / thickness: here both errors are as large. Within 2.5e-4 and 2.5e-2,
/// which is balanced up to 10^4 sizes away.
double least_thickness(double distance);

/// Largest ratio of singular values that is left to fp32 at that distance: 1000 near the eye, 25 from 1700 sizes on.
double largest_condition(double distance);

/// Whether that ratio is at most `limit`. Bounds it by norms, so that matrices beyond a third of it may be turned down.
bool is_well_conditioned(const glm::dmat3& m, double limit);

/// How far a shape reaches along axes of its own, about its middle.
struct Spread {
    glm::dmat3 axes{1};  // orthonormal, right-handed
    glm::dvec3 half{0};
};

/// `m`, changed where it makes the shape thinner than `thickness` of its length: the shape is that thin then, and
/// the matrix has an inverse in fp32. What `m` does along an axis in which the shape is flat already does not matter. Nothing where
/// no area is left.
std::optional<glm::dmat3> thickened(const glm::dmat3& m, const Spread& spread, double thickness);

/// Between the two sides of a flattened shape that stands still, as a share of its largest singular value: what rays in
/// fp32 tell apart, so that they meet the side that faces them.
inline constexpr double least_gap = 1e-5;

/// `m`, changed where it brings the shape's two sides closer than `least_gap`: they are so far apart then, and nothing
/// else is changed. Nothing where no area is left.
std::optional<glm::dmat3> with_sheets_apart(const glm::dmat3& m, const Spread& spread);

}  // namespace diptych::core
