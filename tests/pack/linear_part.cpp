// Singular values, and matrices that are given an inverse.
#include "pack/linear_part.h"

#include <random>

#include "catch.h"

using namespace diptych::core;

namespace {

glm::dmat3 random_matrix(std::mt19937& random) {
    std::normal_distribution<double> normal;
    glm::dmat3 m;
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) {
            m[column][row] = normal(random) * std::pow(10.0, -static_cast<double>(random() % 20));
        }
    }
    return m;
}

double largest_difference(const glm::dmat3& a, const glm::dmat3& b) {
    double largest = 0;
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) {
            largest = std::max(largest, std::abs(a[column][row] - b[column][row]));
        }
    }
    return largest;
}

}  // namespace

TEST_CASE("Singular values and vectors make the matrix, and the vectors are orthogonal") {
    std::mt19937 random(3);
    for (int i = 0; i < 20000; ++i) {
        const glm::dmat3 m = random_matrix(random);
        const SingularValues s = singular_values(m, mirrors(m));
        glm::dmat3 again(0);
        for (int k = 0; k < 3; ++k) {
            again += glm::outerProduct(s.values[k] * s.left[k], s.right[k]);
        }
        REQUIRE(s.values.x >= s.values.y);
        REQUIRE(s.values.y >= s.values.z);
        // Where the sign of the determinant is rounding, the least value may count for its opposite.
        REQUIRE(largest_difference(m, again) <= 1e-14 * s.values.x + (mirrors(m) ? 0 : 2 * s.values.z));
        REQUIRE(largest_difference(glm::transpose(s.left) * s.left, glm::dmat3(1)) < 1e-14);
        REQUIRE(largest_difference(glm::transpose(s.right) * s.right, glm::dmat3(1)) < 1e-14);
    }
    CHECK(singular_values(glm::dmat3(0), false).values == glm::dvec3(0));
}

TEST_CASE("Matrices of rank one and two have singular vectors that are orthogonal too") {
    std::mt19937 random(4);
    std::normal_distribution<double> normal;
    const auto vector = [&] { return glm::dvec3(normal(random), normal(random), normal(random)); };
    for (int i = 0; i < 20000; ++i) {
        glm::dmat3 m = glm::outerProduct(vector(), vector());
        if (i % 2 == 0) {
            m += std::pow(10.0, -static_cast<double>(random() % 20)) * glm::outerProduct(vector(), vector());
        }
        const SingularValues s = singular_values(m, false);
        REQUIRE(s.values.z <= 1e-15 * s.values.x);
        REQUIRE(largest_difference(glm::transpose(s.left) * s.left, glm::dmat3(1)) < 1e-14);
        REQUIRE(largest_difference(glm::transpose(s.right) * s.right, glm::dmat3(1)) < 1e-14);
    }
}

TEST_CASE("Thickened matrices keep what they were and have an inverse") {
    const auto diagonal = [](double x, double y, double z) { return glm::dmat3(x, 0, 0, 0, y, 0, 0, 0, z); };
    const Spread cube{glm::dmat3(1), glm::dvec3(1)};
    CHECK(is_well_conditioned(diagonal(1, 2, 3), 1000));
    CHECK(is_well_conditioned(diagonal(1e-200, 2e-200, 3e-200), 1000));
    CHECK(!is_well_conditioned(diagonal(1, 1, 1e-4), 1000));
    CHECK(!is_well_conditioned(diagonal(1, 0, 1), 1000));
    CHECK(!is_well_conditioned(glm::dmat3(0), 1000));
    const glm::dvec3 along(0.30238010859754544, 0.34341193197561526, 0.21799913662296608);
    CHECK(!is_well_conditioned(glm::dmat3(along, -0.15 * along, 0.0149 * along), 1000));
    CHECK(!thickened(glm::dmat3(along, -0.15 * along, 0.0149 * along), cube, 2.5e-4));
    const auto thick = [&](const glm::dmat3& m, const Spread& spread) { return thickened(m, spread, 2.5e-4).value(); };
    CHECK(largest_difference(thick(diagonal(1, 0.5, 0.01), cube), diagonal(1, 0.5, 0.01)) < 1e-15);
    CHECK(largest_difference(thick(diagonal(20, 0, 20), cube), diagonal(20, 20 * 2.5e-4, 20)) < 1e-12);
    CHECK(!thickened(diagonal(0, 0, 5), cube, 2.5e-4));
    CHECK(!thickened(glm::dmat3(0), cube, 2.5e-4));
    CHECK(least_thickness(0) == 2.5e-4);
    CHECK(least_thickness(1000) == Approx(std::sqrt(6e-5)));
    CHECK(least_thickness(1e9) == 2.5e-2);
    CHECK(largest_condition(0) == 1000);
    CHECK(largest_condition(100) == Approx(0.25 / std::sqrt(6e-6)));
    CHECK(largest_condition(1e9) == 25);
    // A square does not care for what is across it.
    const Spread square{glm::dmat3(1), glm::dvec3(1, 1, 0)};
    CHECK(largest_difference(thick(diagonal(1, 1, 1e9), square), diagonal(1, 1, 1)) < 1e-12);
    CHECK(!thickened(diagonal(1, 0, 1), square, 2.5e-4));
    CHECK(mirrors(diagonal(1, -1, 1)));
    CHECK(mirrors(diagonal(1, -1e-18, 1e9)));
    CHECK(!mirrors(diagonal(1, 0, 1)));
    CHECK(!mirrors(glm::dmat3(0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9)));
}
