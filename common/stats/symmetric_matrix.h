// Symmetric matrices of up to three rows.
#pragma once

#include <array>

namespace diptych::core {

using Matrix3 = std::array<std::array<double, 3>, 3>;

struct Eigen3 {
    std::array<double, 3> values;  // in no order
    Matrix3 vectors;               // vectors[k] belongs to values[k], of length 1
};

/// Jacobi's rotations (1846); only the symmetric part is read.
Eigen3 symmetric_eigen(Matrix3 matrix);

/// The inverse of the leading `rank` rows and columns; false where it is singular.
bool invert(const Matrix3& matrix, int rank, Matrix3& inverse);

}  // namespace diptych::core
