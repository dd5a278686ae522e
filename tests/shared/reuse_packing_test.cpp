// What neighbours read of a surface, value by value: the packing keeps what it says, and the target is Lambert plus GGX in double precision.
#include "restir/reuse_surface.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "catch.h"
#include "direction_chi_square.h"

using namespace diptych::core::shared;
using namespace diptych::core::tests;

namespace {

using dvec3 = glm::dvec3;

/// f90 (cos)^5 + ..., D, and height-correlated G2 of GGX (Heitz 2014, eq. 99), times cos_i; `least` is the floor of cosines.
dvec3 ggx_in_double(const TargetSurface& s, dvec3 wi, double least) {
    const dvec3 n(s.specular_normal);
    const dvec3 wo(s.wo);
    const dvec3 h = glm::normalize(wo + wi);
    const double cos_i = std::clamp(glm::dot(wi, n), least, 1.0);
    const double cos_o = std::clamp(glm::dot(wo, n), least, 1.0);
    const double cos_h = std::max(glm::dot(h, n), 0.0);
    const double a2 = static_cast<double>(s.alpha) * static_cast<double>(s.alpha);
    const double base = glm::dot(glm::cross(h, n), glm::cross(h, n)) + cos_h * cos_h * a2;
    const double d = a2 / (M_PI * base * base);
    const auto lambda = [&](double c) { return 0.5 * (std::sqrt(1.0 + a2 * (1.0 - c * c) / (c * c)) - 1.0); };
    const double g = 1.0 / (1.0 + lambda(cos_i) + lambda(cos_o));
    const double grazing = std::pow(1.0 - glm::dot(wo, h), 5.0);
    const dvec3 fresnel = dvec3(s.f0) + (dvec3(static_cast<double>(s.f90)) - dvec3(s.f0)) * grazing;
    return fresnel * (d * g / (4.0 * cos_o));
}

TargetSurface random_target(Uniforms& u) {
    const vec3 normal = direction_at(2.0 * u.next() - 1.0, 2.0 * M_PI * u.next());
    const Frame frame = frame_from_normal(normal);
    TargetSurface s;
    s.position = vec3(0.0f, 0.0f, 0.0f);
    s.geometric_normal = normal;
    s.normal = to_world(frame, direction_at(0.95 + 0.05 * u.next(), 2.0 * M_PI * u.next()));
    s.specular_normal = to_world(frame, direction_at(0.9 + 0.1 * u.next(), 2.0 * M_PI * u.next()));
    s.wo = to_world(frame, direction_at(u.next(), 2.0 * M_PI * u.next()));
    s.diffuse = vec3(0.7f, 0.5f, 0.2f);
    s.f0 = vec3(0.04f, 0.3f, 0.6f);
    s.f90 = 0.9f;
    s.alpha = static_cast<float>(0.05 + 0.95 * u.next());
    s.flags = REUSE_SURFACE_VALID;
    return s;
}

ReuseSurface placed(vec3 position, vec3 normal) {
    ReuseSurface s = no_reuse_surface();
    s.position = position;
    s.geometric_normal = pack_unit_vector(normal);
    s.normal = pack_unit_vector(normal);
    s.rest = REUSE_SURFACE_VALID;
    return s;
}

}  // namespace

// Half a step of 1/32767 in x and y moves z by both, and the octahedron's faces are 1/sqrt(3) from its centre: 0.5 sqrt(6) sqrt(3) / 32767.
TEST_CASE("Packed unit vectors are within 6.5e-5 of themselves, in all octants") {
    Uniforms u(31);
    double farthest = 0;
    for (int k = 0; k < 200000; ++k) {
        const vec3 v = direction_at(2.0 * u.next() - 1.0, 2.0 * M_PI * u.next());
        const vec3 back = unpack_unit_vector(pack_unit_vector(v));
        farthest = std::max(farthest, static_cast<double>(length(back - v)));
    }
    CHECK(farthest < 6.5e-5);
    for (const vec3 axis : {vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1), vec3(-1, 0, 0), vec3(0, -1, 0), vec3(0, 0, -1)}) {
        CHECK(length(unpack_unit_vector(pack_unit_vector(axis)) - axis) < 1e-6f);
    }
}

TEST_CASE("Signed 16-bit fractions round to the nearest and end at -1 and 1") {
    for (const float x : {-1.0f, -0.75f, -1.0f / 32767.0f, 0.0f, 0.3f, 0.5f, 1.0f}) {
        CAPTURE(x);
        CHECK(std::abs(unpack_snorm16(pack_snorm16(x)) - x) <= 0.5f / 32767.0f + 1e-7f);
    }
    CHECK(unpack_snorm16(pack_snorm16(7.0f)) == 1.0f);
    CHECK(unpack_snorm16(pack_snorm16(-7.0f)) == -1.0f);
    CHECK(unpack_snorm16(pack_snorm16(0.0f)) == 0.0f);
}

TEST_CASE("Packed colours are never darker, by a 511th of the power of two above their largest channel at most") {
    Uniforms u(32);
    const auto check = [](vec3 color) {
        CAPTURE(color.x, color.y, color.z);
        const vec3 back = unpack_color(pack_color(color));
        const float largest = std::max({color.x, color.y, color.z});
        const float step = std::exp2(std::floor(std::log2(largest)) + 1.0f) / 511.0f;
        for (int c = 0; c < 3; ++c) {
            CHECK((back[c] > 0.0f) == (color[c] > 0.0f));
            CHECK(back[c] >= color[c] - 1e-6f * largest);
            CHECK(back[c] <= color[c] + 1.001f * step);
        }
    };
    for (int k = 0; k < 2000; ++k) {
        const float size = std::exp2(static_cast<float>(-20.0 * u.next()));
        check(vec3(static_cast<float>(u.next()), static_cast<float>(u.next()), static_cast<float>(u.next())) * size);
    }
    check(vec3(0.5f, 0.25f, 0.0f));
    check(vec3(0.0f, 1.0e-4f, 0.9f));
    check(vec3(1.0e-7f, 0.0f, 0.0f));
    check(vec3(0.0f, 0.999f, 1.0e-6f));
    CHECK(unpack_color(pack_color(vec3(0.0f, 0.0f, 0.0f))) == vec3(0.0f, 0.0f, 0.0f));
    CHECK(unpack_color(pack_color(vec3(1.0f, 1.0f, 1.0f))) == vec3(1.0f, 1.0f, 1.0f));
    CHECK(unpack_color(pack_color(vec3(5.0f, -1.0f, 1.0f))) == vec3(1.0f, 0.0f, 1.0f));
}

TEST_CASE("A surface comes back as it was packed: colours, widths, flags") {
    SurfaceBsdf b;
    b.parameters = bsdf_parameters(vec3(0.8f, 0.4f, 0.1f), 0.25f, 0.6f, 0.04f, 0.5f, vec3(1.0f, 0.5f, 0.25f), BRDF_GGX);
    b.geometric_normal = b.shading_normal = vec3(0.0f, 0.0f, 1.0f);
    b.mapped_normal = normalize(vec3(0.2f, 0.1f, 1.0f));
    const vec3 wo = normalize(vec3(-0.3f, 0.4f, 0.8f));
    for (const uint mapped : {NORMAL_MAP_NONE, NORMAL_MAP_SHADING, NORMAL_MAP_MICROFACET}) {
        CAPTURE(mapped);
        b.mapped = mapped;
        const TargetSurface t = unpack_reuse_surface(pack_reuse_surface(vec3(1.0f, 2.0f, 3.0f), b, wo), ~0u);
        CHECK(t.position == vec3(1.0f, 2.0f, 3.0f));
        CHECK(length(t.geometric_normal - b.geometric_normal) < 1e-4f);
        CHECK(length(t.wo - wo) < 1e-4f);
        CHECK(length(t.normal - b.mapped_normal) < 1e-4f);
        CHECK(length(t.diffuse - b.parameters.diffuse) < 4e-3f);
        CHECK(length(t.f0 - b.parameters.f0) < 2e-3f);
        CHECK(t.f90 >= b.parameters.f90.x);
        CHECK(t.f90 <= b.parameters.f90.x + 1.001f / 255.0f);
        CHECK(std::abs(t.alpha - b.parameters.alpha) <= 1.001f / 65535.0f);
        CHECK(t.flags == (REUSE_SURFACE_VALID | (mapped == NORMAL_MAP_SHADING      ? REUSE_SURFACE_MAPPED
                                                 : mapped == NORMAL_MAP_MICROFACET ? REUSE_SURFACE_FACETS
                                                                                   : 0u)));
        const vec3 specular =
            mapped == NORMAL_MAP_SHADING ? specular_normal(t.normal, t.geometric_normal, t.wo) : t.normal;
        CHECK(length(t.specular_normal - specular) < 1e-6f);
        CHECK(unpack_reuse_surface(pack_reuse_surface(vec3(0.0f, 0.0f, 0.0f), b, wo), ~FEATURE_NORMAL_MAPS).flags == REUSE_SURFACE_VALID);
    }
    CHECK(!is_valid(no_reuse_surface()));
}

TEST_CASE("The target's specular lobe is GGX in double precision") {
    Uniforms u(33);
    int compared = 0;
    for (int k = 0; k < 20000; ++k) {
        const TargetSurface s = random_target(u);
        const vec3 wi = direction_at(2.0 * u.next() - 1.0, 2.0 * M_PI * u.next());
        if (length(s.wo + wi) < 0.05f) {
            continue;  // opposite directions have no half vector
        }
        const vec3 value = target_specular(s, wi, TARGET_COS_MIN);
        const dvec3 truth = ggx_in_double(s, dvec3(wi), static_cast<double>(TARGET_COS_MIN));
        for (int c = 0; c < 3; ++c) {
            CAPTURE(k, c, truth[c], value[c]);
            REQUIRE(std::abs(static_cast<double>(value[c]) - truth[c]) <= 2e-4 * truth[c] + 1e-7);
        }
        ++compared;
    }
    CHECK(compared > 19000);
    TargetSurface s = random_target(u);
    CHECK(target_specular(s, -s.wo, TARGET_COS_MIN) == vec3(0.0f, 0.0f, 0.0f));
}

TEST_CASE("The target is Lambert plus the specular lobe above the surface, and 0 below") {
    Uniforms u(34);
    for (int k = 0; k < 5000; ++k) {
        TargetSurface s = random_target(u);
        const uint kind = k % 3 == 0 ? 0u : k % 3 == 1 ? REUSE_SURFACE_MAPPED : REUSE_SURFACE_FACETS;
        s.flags |= kind;
        const vec3 wi = direction_at(2.0 * u.next() - 1.0, 2.0 * M_PI * u.next());
        const vec3 value = target_reflectance(s, wi);
        if (dot(wi, s.geometric_normal) < -TARGET_COS_MIN) {
            REQUIRE(value == vec3(0.0f, 0.0f, 0.0f));
            continue;
        }
        const float least = kind == REUSE_SURFACE_FACETS ? 0.1f : 1.0e-3f;
        vec3 truth = target_specular(s, wi, least);
        truth += s.diffuse * (std::clamp(dot(wi, s.normal), least, 1.0f) / 3.14159265f);
        const vec3 below = wi - 2.0f * dot(wi, s.geometric_normal) * s.geometric_normal;
        if (kind == REUSE_SURFACE_MAPPED && dot(below, s.specular_normal) > 0.0f) {
            truth += target_specular(s, normalize(below), least);
        }
        REQUIRE(length(value - truth) <= 1e-3f * length(truth));
    }
}

TEST_CASE("Surfaces are alike that face alike within a cosine of 0.85 and lie in one plane within a twentieth of the eye's distance") {
    const vec3 upward(0.0f, 0.0f, 1.0f);
    const vec3 eye(0.0f, 0.0f, 10.0f);
    const ReuseSurface a = placed(vec3(0.0f, 0.0f, 0.0f), upward);
    const auto tilted = [](float cosine) { return vec3(std::sqrt(1.0f - cosine * cosine), 0.0f, cosine); };
    CHECK(is_similar(a, placed(vec3(3.0f, 2.0f, 0.0f), upward), eye));
    CHECK(is_similar(a, placed(vec3(0.0f, 0.0f, 0.0f), tilted(0.86f)), eye));
    CHECK(!is_similar(a, placed(vec3(0.0f, 0.0f, 0.0f), tilted(0.84f)), eye));
    for (const float side : {-1.0f, 1.0f}) {
        CHECK(is_similar(a, placed(vec3(1.0f, 0.0f, side * 0.49f), upward), eye));
        CHECK(!is_similar(a, placed(vec3(1.0f, 0.0f, side * 0.51f), upward), eye));
    }
    // The distance is that of the first, wherever both are.
    const ReuseSurface b = placed(vec3(4.0f, 5.0f, 6.0f), upward);
    CHECK(is_similar(b, placed(vec3(9.0f, 5.0f, 6.45f), upward), vec3(4.0f, 5.0f, 16.0f)));
    CHECK(!is_similar(b, placed(vec3(4.0f, 5.0f, 6.55f), upward), vec3(4.0f, 5.0f, 16.0f)));
    CHECK(!is_similar(a, no_reuse_surface(), eye));
    CHECK(!is_similar(no_reuse_surface(), a, eye));
}

TEST_CASE("Reuse pays from the least width of a lobe on, also where the view is grazing") {
    SurfaceBsdf b;
    b.geometric_normal = b.shading_normal = b.mapped_normal = vec3(0.0f, 0.0f, 1.0f);
    const auto wants = [&](float alpha, float cosine, uint mapped, float specular) {
        b.parameters = bsdf_parameters(vec3(0.5f, 0.5f, 0.5f), 0.0f, std::sqrt(alpha), 0.04f, specular, vec3(1.0f, 1.0f, 1.0f), BRDF_GGX);
        b.mapped = mapped;
        return wants_reuse(b, vec3(std::sqrt(1.0f - cosine * cosine), 0.0f, cosine));
    };
    CHECK(wants(0.0011f, 1.0f, NORMAL_MAP_NONE, 1.0f));
    CHECK(!wants(0.0009f, 1.0f, NORMAL_MAP_NONE, 1.0f));
    CHECK(wants(0.01f, 0.055f, NORMAL_MAP_NONE, 1.0f));
    CHECK(!wants(0.01f, 0.045f, NORMAL_MAP_NONE, 1.0f));
    CHECK(wants(0.11f, 1.0f, NORMAL_MAP_MICROFACET, 1.0f));
    CHECK(!wants(0.09f, 1.0f, NORMAL_MAP_MICROFACET, 1.0f));
    CHECK(wants(0.09f, 1.0f, NORMAL_MAP_MICROFACET, 0.0f));  // nothing reflects
    CHECK(wants(0.09f, 1.0f, NORMAL_MAP_SHADING, 1.0f));
}

TEST_CASE("Reuse on a surface that a map shades goes by the specular normal, which faces the eye where the map's does not") {
    SurfaceBsdf b;
    const auto at_angle = [](double degrees) { return direction_at(std::cos(degrees * M_PI / 180.0), degrees < 0.0 ? M_PI : 0.0); };
    b.geometric_normal = b.shading_normal = at_angle(0.0);
    b.mapped_normal = at_angle(60.0);
    b.mapped = NORMAL_MAP_SHADING;
    const vec3 wo = at_angle(-60.0);
    // It sends wo where the cosine to the surface is 0.1, and lies halfway.
    const double half = 0.5 * (M_PI / 3.0 + std::acos(0.1));
    const double least = 0.5 * static_cast<double>(TARGET_ALPHA_MIN) / std::cos(half);
    REQUIRE(least > static_cast<double>(TARGET_ALPHA_MIN));
    for (const double factor : {0.98, 1.02}) {
        const auto roughness = static_cast<float>(std::sqrt(factor * least));
        b.parameters = bsdf_parameters(vec3(0.5f, 0.5f, 0.5f), 1.0f, roughness, 0.04f, 1.0f, vec3(1.0f, 1.0f, 1.0f), BRDF_GGX);
        CAPTURE(factor);
        CHECK(wants_reuse(b, wo) == (factor > 1.0));
    }
}
