// What a surface reflects that a normal map shades, term by term: equation 4 of docs/integrand.md in double precision.
#include "bsdf/mapped_bsdf.h"

#include <algorithm>
#include <cmath>

#include "catch.h"
#include "direction_chi_square.h"
#include "known_values.h"
#include "bsdf/surface_bsdf.h"

using namespace diptych::core::shared;
using namespace diptych::core::tests;

namespace {

using dvec3 = glm::dvec3;

dvec3 fresnel(const BsdfParameters& b, double cosine) {
    return dvec3(b.f0) + (dvec3(b.f90) - dvec3(b.f0)) * std::pow(1.0 - cosine, 5.0);
}

/// s_q of the integrand, with GGX.
dvec3 specular(const BsdfParameters& b, const dvec3& q, const dvec3& o, const dvec3& i) {
    const double cos_o = glm::dot(o, q);
    const double cos_i = glm::dot(i, q);
    if (cos_o <= 0.0 || cos_i <= 0.0) {
        return dvec3(0.0);
    }
    const dvec3 h = glm::normalize(o + i);
    const double a2 = static_cast<double>(b.alpha) * static_cast<double>(b.alpha);
    const double cos_h = glm::dot(h, q);
    const double base = cos_h * cos_h * a2 + 1.0 - cos_h * cos_h;
    const auto lambda = [&](double c) { return 0.5 * (std::sqrt(1.0 + a2 * (1.0 - c * c) / (c * c)) - 1.0); };
    const double g = 1.0 / (1.0 + lambda(cos_o) + lambda(cos_i));
    return fresnel(b, glm::dot(o, h)) * (a2 / (M_PI * base * base) * g / (4.0 * cos_o));
}

/// S(i, n, k), the surface's normal being +z.
double terminator(const dvec3& i, const dvec3& n, double k) {
    const double range = k * std::min(0.25, std::hypot(n.x, n.y)) * glm::dot(i, n);
    const double x = range > 0.0 ? std::min(1.0, i.z / range) : 1.0;
    return x + x * x - x * x * x;
}

dvec3 equation_4(const BsdfParameters& b, const dvec3& p, const dvec3& q, const dvec3& o, const dvec3& i) {
    const bool plain = b.f0 == vec3(0.0f, 0.0f, 0.0f) && b.f90 == vec3(0.0f, 0.0f, 0.0f);
    const dvec3 kept = plain ? dvec3(1.0) : dvec3(1.0) - fresnel(b, glm::dot(o, glm::normalize(o + i)));
    const dvec3 diffuse = dvec3(b.diffuse) * kept * (terminator(i, p, 1.0) / M_PI * std::max(glm::dot(i, p), 0.0));
    if (plain) {
        return diffuse;
    }
    const dvec3 below(i.x, i.y, -i.z);
    return diffuse + terminator(i, q, static_cast<double>(b.alpha)) * (specular(b, q, o, i) + specular(b, q, o, below));
}

}  // namespace

TEST_CASE("A surface that a normal map shades reflects what equation 4 of the integrand says") {
    Uniforms u(51);
    int faded = 0;
    for (int k = 0; k < 20000; ++k) {
        const float specular = k % 4 == 0 ? 0.0f : 0.8f;
        SurfaceBsdf s;
        s.parameters = bsdf_parameters(vec3(0.8f, 0.5f, 0.2f), k % 4 < 2 ? 0.0f : u.next(), 0.35f + 0.65f * u.next(), 0.04f, specular,
                                       vec3(1.0f, 0.7f, 0.4f), BRDF_GGX);
        s.geometric_normal = s.shading_normal = up;
        s.mapped_normal = direction_at(0.2 + 0.79 * u.next(), 2.0 * M_PI * u.next());
        s.mapped = NORMAL_MAP_SHADING;
        const vec3 wo = direction_at(0.02 + 0.98 * u.next(), 2.0 * M_PI * u.next());
        const double height = u.next();
        const vec3 wi = direction_at(0.01 + 0.99 * height * height, 2.0 * M_PI * u.next());
        const dvec3 p(s.mapped_normal);
        const dvec3 expected = equation_4(s.parameters, p, dvec3(specular_normal(s.mapped_normal, up, wo)), dvec3(wo), dvec3(wi));
        const dvec3 found(surface_bsdf_eval(s, wo, wi, ~0u));
        CAPTURE(k, wo.x, wo.y, wo.z, wi.x, wi.y, wi.z);
        REQUIRE(glm::length(found - expected) <= 1e-4 * glm::length(expected) + 1e-7);
        faded += terminator(dvec3(wi), p, 1.0) < 1.0 && glm::dot(dvec3(wi), p) > 0.0 ? 1 : 0;
    }
    CHECK(faded > 1000);
}
