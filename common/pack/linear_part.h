// What a transform's linear part does to shapes, however near it is to having no inverse.
#pragma once

#include <glm/glm.hpp>
#include <optional>

namespace diptych {

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

/// Largest ratio of singular values under which fp32 carries rays into a mesh's space and back: silhouettes are within
/// 6e-5 of the mesh's size.
inline constexpr double largest_condition = 1e3;

/// Whether that ratio is no larger. Bounds it by norms, so that matrices beyond a third of it may be turned down.
bool is_well_conditioned(const glm::dmat3& m);

/// Where the ratio is larger, what a moving instance's thickness becomes, as a share of its largest singular value:
/// as much as fp32 then errs in the silhouette.
inline constexpr double least_thickness = 2.5e-4;

/// How far a shape reaches along axes of its own, about its middle.
struct Spread {
    glm::dmat3 axes{1};  // orthonormal, right-handed
    glm::dvec3 half{0};
};

/// `m`, changed where it makes the shape thinner than `least_thickness` of its length: the shape is that thin then, and
/// the matrix has an inverse in fp32. What `m` does along an axis in which the shape is flat already does not matter. Nothing where
/// no area is left.
std::optional<glm::dmat3> thickened(const glm::dmat3& m, const Spread& spread);

/// Between the two sides of a flattened shape that stands still, as a share of its largest singular value: what rays in
/// fp32 tell apart, so that they meet the side that faces them.
inline constexpr double least_gap = 1e-5;

/// `m`, changed where it brings the shape's two sides closer than `least_gap`: they are so far apart then, and nothing
/// else is changed. Nothing where no area is left.
std::optional<glm::dmat3> with_sheets_apart(const glm::dmat3& m, const Spread& spread);

}  // namespace diptych
