// Which lobe and facet a draw picks, how likely, and what its record says.
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

double luminance_in_double(dvec3 c) {
    return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z;
}

/// v turned as the rotation turns that takes unit `from` to unit `to` on the shortest way (Rodrigues' formula).
dvec3 turn(dvec3 v, dvec3 from, dvec3 to) {
    const dvec3 axis = glm::cross(from, to);
    const double sine = glm::length(axis);
    if (sine < 1e-12) {
        return v;
    }
    const dvec3 k = axis / sine;
    const double cosine = glm::dot(from, to);
    return v * cosine + glm::cross(k, v) * sine + k * (glm::dot(k, v) * (1.0 - cosine));
}

SurfaceBsdf surface(const BsdfParameters& p, uint model) {
    SurfaceBsdf s;
    s.parameters = p;
    s.geometric_normal = up;
    s.shading_normal = up;
    s.mapped_normal = normalize(vec3(0.5f, 0.3f, 1.0f));
    s.mapped = model;
    return s;
}

}  // namespace

TEST_CASE("The specular lobe is picked by its share of the luminance, within 0.1 to 0.9") {
    Uniforms u(41);
    int inside = 0;
    for (int k = 0; k < 3000; ++k) {
        const vec3 base(u.next(), u.next(), u.next());
        const BsdfParameters p = bsdf_parameters(base, 0.0f, 0.5f, 0.3f * u.next(), 1.0f, vec3(1.0f, 0.5f, 0.7f), BRDF_GGX);
        const float cosine = u.next();
        const double grazing = std::pow(1.0 - static_cast<double>(cosine), 5.0);
        const dvec3 f0(p.f0);
        const double s = luminance_in_double(f0 + (dvec3(p.f90) - f0) * grazing);
        const double d = luminance_in_double(dvec3(p.diffuse)) * (1.0 - std::min(s, 1.0));
        const vec3 wo(std::sqrt(1.0f - cosine * cosine), 0.0f, cosine);
        const double truth = std::clamp(s / (s + d), 0.1, 0.9);
        inside += truth > 0.1 && truth < 0.9 ? 1 : 0;
        CAPTURE(k, s, d);
        REQUIRE(std::abs(static_cast<double>(bsdf_specular_probability(p, wo, ~0u)) - truth) < 1e-5);
    }
    CHECK(inside > 1000);
    const vec3 black(0.0f, 0.0f, 0.0f);
    const auto single = [&](vec3 base, float f0, float specular) {
        return bsdf_specular_probability(bsdf_parameters(base, 0.0f, 0.5f, f0, specular, white, BRDF_GGX), up, ~0u);
    };
    CHECK(single(black, 0.04f, 1.0f) == 1.0f);
    CHECK(single(white, 0.04f, 0.0f) == 0.0f);
    CHECK(single(black, 0.04f, 0.0f) == -1.0f);
}

TEST_CASE("A draw's record names its lobe, and where a microfacet map tilts its facets") {
    const BsdfParameters plastic = bsdf_parameters(white * 0.5f, 0.0f, 0.6f, 0.2f, 1.0f, white, BRDF_GGX);
    const vec3 wo = normalize(vec3(-0.4f, 0.2f, 0.8f));
    Uniforms u(42);
    for (const uint model : {NORMAL_MAP_NONE, NORMAL_MAP_SHADING, NORMAL_MAP_MICROFACET}) {
        const SurfaceBsdf s = surface(plastic, model);
        const SeenBsdf seen = see_bsdf(s, wo, ~0u);
        int drawn[4] = {};
        for (int k = 0; k < 2000; ++k) {
            const vec2 u_lobe = u.next_pair();
            const BsdfSample r = surface_bsdf_sample(s, seen, u_lobe, u.next_pair(), ~0u);
            if (!(r.pdf > 0.0f)) {
                continue;
            }
            CAPTURE(model, k, u_lobe.x, u_lobe.y);
            ++drawn[r.lobe >> 2];
            if (model != NORMAL_MAP_MICROFACET) {
                REQUIRE(r.lobe == (u_lobe.x < seen.p_specular ? LOBE_SPECULAR : LOBE_DIFFUSE));
                continue;
            }
            const FacetPair pair = make_facet_pair(s.shading_normal, seen.normal, s.mapped_normal);
            REQUIRE((r.lobe & 3u) != 0u);
            REQUIRE((r.lobe & (u_lobe.y < mapped_facet_probability(pair, seen.wo) ? FACET_MAPPED : FACET_TANGENT)) != 0u);
        }
        CAPTURE(model);
        if (model == NORMAL_MAP_MICROFACET) {  // each facet alone, and both
            CHECK(drawn[0] == 0);
            CHECK(std::min({drawn[1], drawn[2], drawn[3]}) > 5);
        } else {
            CHECK(drawn[0] > 1000);
        }
    }
}

TEST_CASE("The facets of a microfacet map are turned along with the shading normal, and mask each other as areas do") {
    Uniforms u(43);
    int masked = 0;
    for (int k = 0; k < 5000; ++k) {
        const vec3 shading = direction_at(0.5 + 0.5 * u.next(), 2.0 * M_PI * u.next());
        const vec3 normal = direction_at(0.5 + 0.5 * u.next(), 2.0 * M_PI * u.next());
        const vec3 mapped = direction_at(0.3 + 0.7 * u.next(), 2.0 * M_PI * u.next());
        const FacetPair m = make_facet_pair(shading, normal, mapped);
        const dvec3 turned = turn(dvec3(mapped), dvec3(shading), dvec3(normal));
        const dvec3 g(normal);
        const dvec3 p(m.facet);
        if (glm::dot(turned, g) > 0.011) {
            REQUIRE(glm::length(turned - p) < 2e-5);
        }
        const double cosine = glm::dot(p, g);
        const double sine = glm::length(glm::cross(p, g));
        if (sine < 0.05) {
            continue;
        }
        const dvec3 t = -(p - cosine * g) / sine;
        const vec3 w = direction_at(u.next(), 2.0 * M_PI * u.next());
        const double seen_p = std::max(glm::dot(dvec3(w), p), 0.0);
        const double seen_t = std::max(glm::dot(dvec3(w), t), 0.0) * sine;
        const double seen_g = std::max(glm::dot(dvec3(w), g), 0.0) * cosine;
        CAPTURE(k, seen_p, seen_t, seen_g);
        REQUIRE(length(m.tangent - vec3(t)) < 1e-4f);
        const double truth = seen_g < seen_p + seen_t ? seen_g / (seen_p + seen_t) : 1.0;
        masked += truth < 0.9 ? 1 : 0;
        REQUIRE(std::abs(static_cast<double>(facet_masking(m, w)) - truth) < 1e-4);
        if (seen_p > 1e-3) {
            REQUIRE(std::abs(static_cast<double>(mapped_facet_probability(m, w)) - seen_p / (seen_p + seen_t)) < 1e-3);
        }
    }
    CHECK(masked > 500);
}

TEST_CASE("A chain of mirrors keeps its directions unit") {
    Uniforms u(44);
    SurfaceBsdf s = surface(bsdf_parameters(white, 1.0f, 0.0f, 0.04f, 1.0f, white, BRDF_GGX), NORMAL_MAP_NONE);
    vec3 wo = direction_at(0.7, 1.0);
    float farthest = 0.0f;
    for (int k = 0; k < 20000; ++k) {
        vec3 normal = direction_at(2.0 * u.next() - 1.0, 2.0 * M_PI * u.next());
        normal = dot(normal, wo) < 0.0f ? -normal : normal;
        s.geometric_normal = s.shading_normal = s.mapped_normal = normal;
        const vec2 u_lobe = u.next_pair();
        const BsdfSample r = surface_bsdf_sample(s, wo, u_lobe, u.next_pair(), ~0u);
        if (r.pdf > 0.0f) {
            REQUIRE(r.delta != 0u);
            wo = -r.direction;
            farthest = std::max(farthest, std::abs(length(wo) - 1.0f));
        }
    }
    CHECK(farthest < 2e-7f);
}
