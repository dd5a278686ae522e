// The truth in double precision, by textbook formulas; nothing of it is shared with what is measured.
#pragma once

#include <glm/glm.hpp>
#include <numbers>

namespace diptych::core::stability {

inline constexpr double pi = std::numbers::pi;

/// GGX (Walter et al. 2007, eq. 33) and normalised Blinn-Phong (eq. 30, exponent 2/alpha^2 - 2) of a half vector.
double ggx_distribution(const glm::dvec3& h, double alpha);
double blinn_phong_distribution(const glm::dvec3& h, double alpha);

/// Smith's G1 and height-correlated G2 of GGX (Heitz 2014, eq. 72 and 99).
double ggx_masking(const glm::dvec3& w, double alpha);
double ggx_masking_shadowing(const glm::dvec3& o, const glm::dvec3& i, double alpha);

/// What a white GGX mirror reflects of the light toward `o`, by quadrature over facets.
double ggx_albedo(double cosine, double alpha);

/// Solid angle of a triangle seen from the origin, by the three edges' determinant (Van Oosterom and Strackee 1983).
double solid_angle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

/// Irradiance over L below a square of half side `half` centred at `height` (Lambert's formula).
double square_irradiance(double half, double height);

}  // namespace diptych::core::stability
