#include "references.h"

#include <cmath>

namespace diptych::core::stability {

namespace {

double sine_squared(const glm::dvec3& w) {
    return w.x * w.x + w.y * w.y;
}

/// Of a vector that rounding may have left a little off unit length: by its direction alone.
double lambda(const glm::dvec3& w, double alpha) {
    const double tan2 = sine_squared(w) / (w.z * w.z);
    const double a2t2 = alpha * alpha * tan2;
    return 0.5 * a2t2 / (1 + std::sqrt(1 + a2t2));
}

}  // namespace

double ggx_distribution(const glm::dvec3& h, double alpha) {
    const double t = h.z * h.z * alpha * alpha + sine_squared(h);
    return alpha * alpha / (pi * t * t);
}

double blinn_phong_distribution(const glm::dvec3& h, double alpha) {
    const double n = 2 / (alpha * alpha) - 2;
    const double squared = sine_squared(h) + h.z * h.z;
    const double log_cosine_squared = h.z * h.z < 0.5 ? std::log(h.z * h.z / squared)  // neither cancels
                                                      : std::log1p(-sine_squared(h) / squared);
    return (n + 2) / (2 * pi) * std::exp(0.5 * n * log_cosine_squared);
}

double ggx_masking(const glm::dvec3& w, double alpha) {
    return 1 / (1 + lambda(w, alpha));
}

double ggx_masking_shadowing(const glm::dvec3& o, const glm::dvec3& i, double alpha) {
    return 1 / (1 + lambda(o, alpha) + lambda(i, alpha));
}

double ggx_albedo(double cosine, double alpha) {
    const glm::dvec3 o(std::sqrt((1 - cosine) * (1 + cosine)), 0, cosine);
    constexpr int rings = 512;
    constexpr int turns = 512;
    double sum = 0;
    for (int i = 0; i < rings; ++i) {
        // v = 1/sqrt(1 + tan^2/alpha^2), so that a lobe of any width is spread alike.
        const double v = 1 - (i + 0.5) / rings;
        const double tan2 = alpha * alpha * (1 / (v * v) - 1);
        const double c = 1 / std::sqrt(1 + tan2);
        const double s = std::sqrt(tan2) * c;
        const double measure = 2 * pi * c * c * c * alpha * alpha / (v * v * v) / (double{rings} * turns);
        for (int j = 0; j < turns; ++j) {
            const double azimuth = 2 * pi * (j + 0.5) / turns;
            const glm::dvec3 h(s * std::cos(azimuth), s * std::sin(azimuth), c);
            const double facing = glm::dot(o, h);
            const glm::dvec3 w = 2 * facing * h - o;
            if (facing > 0 && w.z > 0) {
                sum += measure * ggx_distribution(h, alpha) * ggx_masking_shadowing(o, w, alpha) * facing / o.z;
            }
        }
    }
    return sum;
}

double solid_angle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const double la = glm::length(a);
    const double lb = glm::length(b);
    const double lc = glm::length(c);
    const double volume = std::abs(glm::dot(a, glm::cross(b - a, c - a)));
    const double below = la * lb * lc + glm::dot(a, b) * lc + glm::dot(a, c) * lb + glm::dot(b, c) * la;
    return 2 * std::atan2(volume, below);
}

double square_irradiance(double half, double height) {
    const double x = half / height;
    const double root = std::sqrt(1 + x * x);
    return 4 * (x / root) * std::atan(x / root);
}

}  // namespace diptych::core::stability
