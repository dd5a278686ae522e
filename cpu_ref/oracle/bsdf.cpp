#include "oracle/bsdf.h"

#include <cmath>

namespace diptych::core::oracle {

namespace {

double square(double x) {
    return x * x;
}

}  // namespace

double ndf(Distribution model, double alpha, double cosine, double sine_squared) {
    if (model == Distribution::ggx) {  // Walter et al. 2007, eq. 33
        return square(alpha) / (pi * square(square(cosine * alpha) + sine_squared));
    }
    const double e = 2 / square(alpha) - 2;  // ibid., eq. 30
    return (e + 2) / (2 * pi) * glm::max(std::exp(0.5 * e * std::log1p(-glm::min(sine_squared, 1.0))), 0x1p-86);
}

double smith_lambda(Distribution model, double alpha, double c) {
    const double tan_squared = glm::max(1 - c * c, 0.0) / square(c);
    const double ggx = 0.5 * (std::sqrt(1 + square(alpha) * tan_squared) - 1);  // Heitz 2014, eq. 72
    if (model == Distribution::ggx) {
        return ggx;
    }
    // Walter et al. 2007, eq. 27, as Lambda = 1/G1 - 1.
    const double a = tan_squared > 0 ? glm::min(1 / (alpha * std::sqrt(tan_squared)), 1.6) : 1.6;
    const double beckmann = glm::max((1 - 1.259 * a + 0.396 * a * a) / (3.535 * a + 2.181 * a * a), 0.0);
    const double t = square(alpha);
    return beckmann + (ggx - beckmann) * t * (0.453 + 0.391 * t - 0.139 * t * t + 0.295 * t * t * t);
}

double sample_ndf_cosine(Distribution model, double alpha, double u) {
    if (model == Distribution::ggx) {  // Walter et al. 2007, eq. 35
        return std::sqrt((1 - u) / (1 - u + square(alpha) * u));
    }
    return std::pow(1 - u, 0.5 * square(alpha));  // 1 / (e + 2)
}

dvec3 fresnel(const Bsdf& bsdf, double cosine) {
    const double x = 1 - glm::clamp(cosine, 0.0, 1.0);
    return bsdf.f0 + (bsdf.f90 - bsdf.f0) * (square(square(x)) * x);  // Schlick 1994
}

dvec3 evaluate(const Bsdf& bsdf, const dvec3& n, const dvec3& o, const dvec3& i) {
    const double cos_o = dot(o, n);
    const double cos_i = dot(i, n);
    if (!(cos_o > 0 && cos_i > 0)) {
        return dvec3(0);
    }
    const dvec3 h = normalize(o + i);
    const dvec3 f = fresnel(bsdf, dot(o, h));
    dvec3 value = bsdf.diffuse / pi * (1.0 - f);
    if (!bsdf.is_mirror() && bsdf.has_specular()) {
        const dvec3 across = cross(h, n);
        const double d = ndf(bsdf.model, bsdf.alpha, dot(h, n), dot(across, across));
        const double g = 1 / (1 + smith_lambda(bsdf.model, bsdf.alpha, cos_o) +
                              smith_lambda(bsdf.model, bsdf.alpha, cos_i));  // Heitz 2014, eq. 99
        value += f * (d * g / (4 * cos_o * cos_i));
    }
    return value * cos_i;
}

/// Any number in (0, 1) is right where both parts exist.
double specular_share(const Bsdf& bsdf, const dvec3& n, const dvec3& o) {
    const bool diffuse = bsdf.diffuse != dvec3(0);
    if (!diffuse || !bsdf.has_specular()) {
        return diffuse ? 0 : 1;
    }
    const double specular = largest(fresnel(bsdf, dot(o, n)));
    return glm::clamp(specular / (specular + largest(bsdf.diffuse)), 0.1, 0.9);
}

Scattered sample_mirror(const Bsdf& bsdf, const dvec3& n, const dvec3& o) {
    Scattered drawn;
    drawn.mirrored = true;
    if (bsdf.is_mirror() && dot(o, n) > 0) {
        drawn.i = normalize(-flip_across(o, n));
        drawn.weight = fresnel(bsdf, dot(o, n));
    }
    return drawn;
}

Scattered sample(const Bsdf& bsdf, const dvec3& n, const dvec3& o, Random& random) {
    Scattered drawn;
    const double cos_o = dot(o, n);
    if (!(cos_o > 0)) {
        return drawn;
    }
    const double share = specular_share(bsdf, n, o);
    const bool specular = random.uniform() < share;
    if (specular && bsdf.is_mirror()) {
        drawn = sample_mirror(bsdf, n, o);
        drawn.weight /= share;
        return drawn;
    }
    const double u = random.uniform();
    const double angle = 2 * pi * random.uniform();
    if (!specular) {
        drawn.i = around(n, std::sqrt(1 - u), angle);
        const dvec3 h = normalize(o + drawn.i);
        drawn.weight = bsdf.diffuse * (1.0 - fresnel(bsdf, dot(o, h))) / (1 - share);
        return drawn;
    }
    const double cos_h = sample_ndf_cosine(bsdf.model, bsdf.alpha, u);
    const dvec3 h = around(n, cos_h, angle);
    const double o_h = dot(o, h);
    drawn.i = normalize(-flip_across(o, h));
    const double cos_i = dot(drawn.i, n);
    if (!(o_h > 0 && cos_i > 0 && cos_h > 0)) {
        return drawn;
    }
    // F D G / (4 cos_o cos_i) cos_i over the density D cos_h / (4 o·h).
    const double g =
        1 / (1 + smith_lambda(bsdf.model, bsdf.alpha, cos_o) + smith_lambda(bsdf.model, bsdf.alpha, cos_i));
    drawn.weight = fresnel(bsdf, o_h) * (g * o_h / (cos_o * cos_h * share));
    return drawn;
}

double density(const Bsdf& bsdf, const dvec3& n, const dvec3& o, const dvec3& i) {
    const double cos_i = dot(i, n);
    if (!(dot(o, n) > 0 && cos_i > 0)) {
        return 0;
    }
    const double share = specular_share(bsdf, n, o);
    double sum = (1 - share) * cos_i / pi;
    if (share > 0 && !bsdf.is_mirror()) {
        const dvec3 h = normalize(o + i);
        const dvec3 across = cross(h, n);
        const double d = ndf(bsdf.model, bsdf.alpha, dot(h, n), dot(across, across));
        sum += share * d * dot(h, n) / (4 * dot(o, h));  // Walter et al. 2007, eq. 14, 24
    }
    return sum;
}

dvec3 around(const dvec3& n, double c, double angle) {
    const dvec3 helper = std::abs(n.x) < 0.6 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
    const dvec3 t = normalize(cross(helper, n));
    const dvec3 b = cross(n, t);
    const double s = std::sqrt(glm::max(1 - c * c, 0.0));
    return normalize(t * (s * std::cos(angle)) + b * (s * std::sin(angle)) + n * c);
}

dvec3 with_cosine(const dvec3& n, const dvec3& axis, double c) {
    const dvec3 across = n - dot(n, axis) * axis;
    const double size = length(across);
    return size > 0 ? c * axis + std::sqrt(1 - c * c) / size * across : axis;
}

}  // namespace diptych::core::oracle
