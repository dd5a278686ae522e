// What tests of the oracle share: small scenes, renders of them, and checks of means that can fail both ways: by a
// difference, and by a want of power.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "oracle/oracle.h"
#include "generate/generate.h"
#include "generate/shapes.h"

namespace diptych::core::tests {

using glm::dvec2;
using glm::dvec3;
using glm::vec3;

/// A mean over a render's samples and its standard error.
struct Estimate {
    dvec3 mean{0};
    dvec3 error{0};
};

/// Largest |z| that passes: two-sided p = 7e-6, so that the suite's several hundred comparisons fail by chance once in
/// some hundred changes of seeds.
inline constexpr double z_limit = 4.5;

struct Rendered {
    OracleSettings settings;
    OracleImage image;

    /// Mean over the image of what was scattered `depth` times.
    Estimate depth(unsigned depth) const;
    /// Mean over the image of everything.
    Estimate all() const;
};

/// `by_depth` is always kept.
Rendered render(const Scene& scene, OracleSettings settings, std::uint64_t spp, int threads = 0);

/// Red, green and blue of `e` are `truth` within z_limit standard errors plus `systematic` of the truth, and 1.96
/// standard errors are at most `half_width` of it.
void check_mean(const Estimate& e, const dvec3& truth, double half_width = 0.003, double systematic = 1e-6);
inline void check_mean(const Estimate& e, double truth, double half_width = 0.003, double systematic = 1e-6) {
    check_mean(e, dvec3(truth), half_width, systematic);
}

/// Two estimates from different random numbers agree, and their difference's 1.96 standard errors are at most
/// `half_width`.
void check_equal(const Estimate& a, const Estimate& b, double half_width);

/// Scatters nothing but diffusely: no Fresnel term, so that closed forms hold.
Material lambertian(const vec3& albedo);
/// Microfacets of the roughness, as glTF has them.
Material glossy(const vec3& color, float metallic, float roughness);

/// A unit vector at that cosine from z and that angle about it.
inline dvec3 from_angles(double cosine, double angle) {
    const double sine = std::sqrt(glm::max(1 - cosine * cosine, 0.0));
    return {sine * std::cos(angle), sine * std::sin(angle), cosine};
}

Primitive quad(const vec3& a, const vec3& b, const vec3& c, const vec3& d, int material);

/// Looks along a beam so narrow that it sees one point.
Camera narrow_camera(const dvec3& eye, const dvec3& target);

OracleSettings small_settings(int width, int height, unsigned max_depth);

Environment constant_sky(const vec3& radiance);

PunctualLight point_light(const dvec3& position, const vec3& intensity);

/// Irradiance at a point with normal n from a polygon of radiance 1, all of it above the horizon (Lambert 1760).
double polygon_irradiance(const std::vector<dvec3>& polygon, const dvec3& point, const dvec3& n);

const std::vector<oracle::Mode>& all_modes();
const char* name_of(oracle::Mode mode);

}  // namespace diptych::core::tests
