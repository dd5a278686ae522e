#include "stats/symmetric_matrix.h"

#include <cmath>

namespace diptych::core {

namespace {

/// Turns rows and columns i, j so that the entry between them vanishes.
void rotate(Matrix3& m, Matrix3& vectors, std::size_t i, std::size_t j) {
    if (m[i][j] == 0) {
        return;
    }
    const double theta = (m[j][j] - m[i][i]) / (2 * m[i][j]);
    const double t = std::copysign(1 / (std::abs(theta) + std::hypot(theta, 1.0)), theta);
    const double c = 1 / std::hypot(t, 1.0);
    const double s = t * c;
    for (std::size_t k = 0; k < 3; ++k) {
        const double x = m[k][i];
        const double y = m[k][j];
        m[k][i] = c * x - s * y;
        m[k][j] = s * x + c * y;
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const double x = m[i][k];
        const double y = m[j][k];
        m[i][k] = c * x - s * y;
        m[j][k] = s * x + c * y;
        const double u = vectors[i][k];
        const double v = vectors[j][k];
        vectors[i][k] = c * u - s * v;
        vectors[j][k] = s * u + c * v;
    }
}

}  // namespace

Eigen3 symmetric_eigen(Matrix3 matrix) {
    Matrix3 vectors{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (int sweep = 0; sweep < 12; ++sweep) {
        rotate(matrix, vectors, 0, 1);
        rotate(matrix, vectors, 0, 2);
        rotate(matrix, vectors, 1, 2);
    }
    return {{matrix[0][0], matrix[1][1], matrix[2][2]}, vectors};
}

bool invert(const Matrix3& m, int rank, Matrix3& inverse) {
    if (rank == 1) {
        inverse[0][0] = 1 / m[0][0];
        return m[0][0] > 0;
    }
    if (rank == 2) {
        const double determinant = m[0][0] * m[1][1] - m[0][1] * m[0][1];
        inverse[0] = {m[1][1] / determinant, -m[0][1] / determinant, 0};
        inverse[1] = {-m[0][1] / determinant, m[0][0] / determinant, 0};
        return determinant > 1e-12 * m[0][0] * m[1][1];
    }
    const double a = m[1][1] * m[2][2] - m[1][2] * m[1][2];
    const double b = m[0][2] * m[1][2] - m[0][1] * m[2][2];
    const double c = m[0][1] * m[1][2] - m[0][2] * m[1][1];
    const double determinant = m[0][0] * a + m[0][1] * b + m[0][2] * c;
    const double d = (m[0][0] * m[2][2] - m[0][2] * m[0][2]) / determinant;
    const double e = (m[0][1] * m[0][2] - m[0][0] * m[1][2]) / determinant;
    const double f = (m[0][0] * m[1][1] - m[0][1] * m[0][1]) / determinant;
    inverse = {{{a / determinant, b / determinant, c / determinant}, {b / determinant, d, e}, {c / determinant, e, f}}};
    return determinant > 1e-12 * m[0][0] * m[1][1] * m[2][2];
}

}  // namespace diptych::core
