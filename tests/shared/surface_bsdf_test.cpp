#include "bsdf/surface_bsdf.h"

#include <algorithm>
#include <array>
#include <bit>

#include "catch.h"
#include "direction_chi_square.h"
#include "known_values.h"

using namespace diptych::core::shared;
using namespace diptych::core::tests;

namespace {

constexpr uint all_features = ~0u;

BsdfParameters white_diffuse() {
    return bsdf_parameters(white, 0.0f, 1.0f, 0.0f, 0.0f, white, BRDF_GGX);
}
BsdfParameters white_metal(float roughness) {
    return bsdf_parameters(white, 1.0f, roughness, 0.0f, 1.0f, white, BRDF_GGX);
}
BsdfParameters plastic(float roughness) {
    return bsdf_parameters(vec3(0.8f, 0.5f, 0.2f), 0.0f, roughness, 0.04f, 1.0f, white, BRDF_GGX);
}

/// On the plane z = 0, its mapped normal tilted toward the azimuth.
SurfaceBsdf mapped_surface(const BsdfParameters& p, double tilt_degrees, double azimuth,
                           uint model = NORMAL_MAP_SHADING) {
    SurfaceBsdf s;
    s.parameters = p;
    s.geometric_normal = up;
    s.shading_normal = up;
    s.mapped_normal = direction_at(std::cos(tilt_degrees * M_PI / 180.0), azimuth);
    s.mapped = normal_map_model(model, s.shading_normal, s.mapped_normal);
    return s;
}

vec3 at_degrees(double view, double azimuth) {
    return direction_at(std::cos(view * M_PI / 180.0), azimuth);
}

/// Directional albedo by the mean weight of the surface's samples; `largest` gets the largest weight.
double sampled_albedo(const SurfaceBsdf& s, vec3 wo, int draws, uint32_t seed, float& largest) {
    Uniforms u(seed);
    double sum = 0.0;
    largest = 0.0f;
    for (int k = 0; k < draws; ++k) {
        const vec2 u_lobe = u.next_pair();
        const BsdfSample r = surface_bsdf_sample(s, wo, u_lobe, u.next_pair(), all_features);
        sum += static_cast<double>(r.weight.x);
        largest = std::max(largest, r.weight.x);
    }
    return sum / draws;
}

bool same_bits(vec3 a, vec3 b) {
    return std::bit_cast<uint>(a.x) == std::bit_cast<uint>(b.x) &&
           std::bit_cast<uint>(a.y) == std::bit_cast<uint>(b.y) && std::bit_cast<uint>(a.z) == std::bit_cast<uint>(b.z);
}

}  // namespace

TEST_CASE("A bent normal is the nearest one that wo is above") {
    Uniforms u(31);
    int64_t bad = 0;
    int64_t bent = 0;
    for (int k = 0; k < 100000; ++k) {
        const vec3 ng = up;
        const vec3 ns = direction_at(u.next(), 6.283 * u.next());
        const vec3 wo = direction_at(1e-6 + (1.0 - 1e-6) * u.next(), 6.283 * u.next());
        const vec3 n = bent_normal(ns, ng, wo);
        const bool was_above = dot(ns, wo) >= BENT_COS;
        bent += was_above ? 0 : 1;
        bool ok = close(length(n), 1.0, 1e-6) && dot(n, ng) > 0.0f && dot(n, wo) > 0.99f * BENT_COS;
        if (was_above) {
            ok = ok && (same_bits(n, ns) || ns.z <= 0.0f);
        } else {
            // The angle turned is what was missing, no more.
            const double turned = std::acos(std::clamp(static_cast<double>(dot(n, ns)), -1.0, 1.0));
            const double missing =
                std::acos(static_cast<double>(dot(ns, wo))) - std::acos(static_cast<double>(BENT_COS));
            ok = ok && std::abs(turned - missing) < 2e-3;
        }
        bad += ok ? 0 : 1;
    }
    CHECK(bad == 0);
    CHECK(bent > 5000);
}

TEST_CASE("A normal map that does not tilt changes no bit, and neither does its feature bit where there is no map") {
    Uniforms u(32);
    int64_t different = 0;
    for (int k = 0; k < 100000; ++k) {
        SurfaceBsdf plain;
        plain.parameters = k % 3 == 0 ? plastic(u.next()) : white_metal(u.next());
        plain.geometric_normal = up;
        plain.shading_normal = direction_at(0.1 + 0.9 * u.next(), 6.0 * u.next());
        plain.mapped_normal = plain.shading_normal;
        plain.mapped = 0u;
        SurfaceBsdf mapped = plain;
        mapped.mapped = normal_map_model(NORMAL_MAP_SHADING, plain.shading_normal, plain.mapped_normal);
        const vec3 wo = direction_at(1.0 - u.next(), 6.0 * u.next());
        const vec3 wi = direction_at(1.0 - u.next(), 6.0 * u.next());
        const vec2 u_lobe = u.next_pair();
        const vec2 facet = u.next_pair();
        const uint without = all_features & ~FEATURE_NORMAL_MAPS;
        const BsdfSample a = surface_bsdf_sample(plain, wo, u_lobe, facet, all_features);
        const BsdfSample b = surface_bsdf_sample(mapped, wo, u_lobe, facet, all_features);
        const BsdfSample c = surface_bsdf_sample(plain, wo, u_lobe, facet, without);
        const vec3 f = surface_bsdf_eval(plain, wo, wi, all_features);
        const bool same =
            same_bits(a.direction, b.direction) && same_bits(a.weight, b.weight) && a.pdf == b.pdf &&
            same_bits(a.direction, c.direction) && same_bits(a.weight, c.weight) && a.pdf == c.pdf &&
            same_bits(f, surface_bsdf_eval(mapped, wo, wi, all_features)) &&
            same_bits(f, surface_bsdf_eval(plain, wo, wi, without)) &&
            surface_bsdf_pdf(plain, wo, wi, all_features) == surface_bsdf_pdf(mapped, wo, wi, all_features);
        different += same ? 0 : 1;
    }
    CHECK(different == 0);
}

namespace {

void check_mapped_draws(int64_t draws) {
    struct Case {
        BsdfParameters p;
        double tilt;
        double view;
        double view_azimuth;
        double smooth_tilt;
        uint model;
    };
    std::vector<Case> cases;
    for (const uint model : {NORMAL_MAP_SHADING, NORMAL_MAP_MICROFACET}) {
        for (const BsdfParameters& p : {white_diffuse(), white_metal(0.6f), plastic(0.5f), plastic(0.0f)}) {
            cases.push_back({p, 20.0, 30.0, 0.9, 0.0, model});
            cases.push_back({p, 60.0, 50.0, 3.6, 0.0, model});
            cases.push_back({p, 40.0, 80.0, 2.3, 0.0, model});
            cases.push_back({p, 80.0, 70.0, 0.5, 0.0, model});
            cases.push_back({p, 40.0, 50.0, 2.45, 0.0, model});  // sees both facets of the microfacet model
            cases.push_back({p, 40.0, 60.0, 2.3, 20.0, model});
            cases.push_back({p, 0.0, 80.0, 2.3, 30.0, model});
        }
    }
    uint32_t seed = 500;
    int64_t all_deltas = 0;
    for (const Case& c : cases) {
        SurfaceBsdf s = mapped_surface(c.p, c.tilt, 0.45);
        s.shading_normal = at_degrees(c.smooth_tilt, 5.0);
        s.mapped = c.model;
        const vec3 wo = at_degrees(c.view, c.view_azimuth);
        Uniforms u(seed++);
        int64_t inconsistent = 0;
        int64_t deltas = 0;
        const auto draw = [&](vec3& wi) {
            const vec2 u_lobe = u.next_pair();
            const BsdfSample r = surface_bsdf_sample(s, wo, u_lobe, u.next_pair(), all_features);
            wi = r.direction;
            if (r.delta != 0u) {
                ++deltas;
                return false;
            }
            if (r.pdf > 0.0f) {
                const float pdf = surface_bsdf_pdf(s, wo, wi, all_features);
                const vec3 f = surface_bsdf_eval(s, wo, wi, all_features);
                inconsistent +=
                    close(r.pdf, pdf, 1e-3) && close(r.weight.x, f.x / pdf, 1e-3) && close(length(wi), 1.0, 1e-6) ? 0
                                                                                                                  : 1;
            }
            return r.pdf > 0.0f;
        };
        const auto pdf = [&](vec3 wi) { return surface_bsdf_pdf(s, wo, wi, all_features); };
        const ChiSquareResult r = chi_square(hemisphere_chart(), draws, draw, pdf);
        INFO("model " << c.model << " alpha " << c.p.alpha << " f0 " << c.p.f0.x << " tilt " << c.tilt << " view " << c.view << " smooth "
                      << c.smooth_tilt << " null " << r.null_fraction << " integral " << r.pdf_integral);
        CHECK(r.impossible == 0);
        CHECK(inconsistent == 0);
        CHECK(r.quadrature < quadrature_limit);
        CHECK(r.p > sidak_threshold(static_cast<int>(cases.size())));
        CHECK(std::abs(1.0 - r.null_fraction - r.pdf_integral) <
              1e-3 + 2.0 * std::sqrt(0.25 / static_cast<double>(draws)));
        CHECK((c.p.alpha == 0.0f || deltas == 0));
        all_deltas += deltas;
    }
    CHECK(all_deltas > 0);
}

}  // namespace

TEST_CASE("A mapped surface draws directions with the density that it states") {
    check_mapped_draws(100000);
}

TEST_CASE("A million directions off a mapped surface have the density that it states", "[nightly]") {
    check_mapped_draws(1000000);
}

TEST_CASE("A direction drawn weighs what the surface reflects that way over its density, by any normal map and by none") {
    Uniforms u(36);
    std::array<int, 3> drawn{};
    int different = 0;
    for (int k = 0; k < 60000; ++k) {
        const auto model = static_cast<std::size_t>(k % 3);
        SurfaceBsdf s;
        s.parameters = k % 2 == 0 ? plastic(0.1f + 0.9f * u.next()) : white_metal(0.1f + 0.9f * u.next());
        s.geometric_normal = up;
        s.shading_normal = direction_at(0.3 + 0.7 * u.next(), 6.28 * u.next());
        s.mapped_normal = model == NORMAL_MAP_NONE ? s.shading_normal : direction_at(0.3 + 0.7 * u.next(), 6.28 * u.next());
        s.mapped = static_cast<uint>(model);
        const vec3 wo = direction_at(0.05 + 0.95 * u.next(), 6.28 * u.next());
        const vec2 u_lobe = u.next_pair();
        const BsdfSample r = surface_bsdf_sample(s, wo, u_lobe, u.next_pair(), all_features);
        if (!(r.pdf > 0.0f)) {
            continue;
        }
        const BsdfValue v = surface_bsdf_eval_pdf(s, wo, r.direction, all_features);
        ++drawn.at(model);
        different += close(r.pdf, v.pdf, 1e-3) && length(r.weight - v.value / v.pdf) < 1e-3f * length(r.weight) + 1e-6f ? 0 : 1;
    }
    CHECK(different == 0);
    CHECK(*std::min_element(drawn.begin(), drawn.end()) > 12000);
}

TEST_CASE("A tilted microfacet map neither makes light nor loses any") {
    // What the facet alone reflects, of single bounces off GGX, is all there is to keep.
    struct Material {
        const char* name;
        BsdfParameters p;
        double least_mean[5];
    };
    const Material materials[] = {{"diffuse", white_diffuse(), {0.999, 0.999, 0.999, 0.999, 0.999}},
                                  {"rough metal", white_metal(0.3f), {0.94, 0.94, 0.94, 0.94, 0.94}},
                                  {"mirror", white_metal(0.0f), {0.999, 0.999, 0.999, 0.999, 0.999}}};
    float largest_weight = 0.0f;
    for (const Material& m : materials) {
        for (int k = 0; k < 5; ++k) {
            const double tilt = 20.0 * k;
            double mean = 0.0;
            double least = 2.0;
            for (const double view : {0.0, 20.0, 40.0, 60.0, 75.0, 85.0}) {
                for (const double azimuth : {0.0, M_PI / 2.0, M_PI}) {
                    const SurfaceBsdf s = mapped_surface(m.p, tilt, 0.45, NORMAL_MAP_MICROFACET);
                    float largest = 0.0f;
                    const double albedo = sampled_albedo(s, at_degrees(view, 0.45 + azimuth), 4000, 600, largest);
                    largest_weight = std::max(largest_weight, largest);
                    INFO(m.name << " tilt " << tilt << " view " << view << " azimuth " << azimuth << " albedo "
                                << albedo);
                    CHECK(albedo < 1.0 + 1e-3);
                    mean += albedo / 18.0;
                    least = std::min(least, albedo);
                }
            }
            INFO(m.name << " tilt " << tilt << " mean " << mean << " least " << least);
            CHECK(mean > m.least_mean[k]);
            // Also where the mapped normal faces away from the eye.
            CHECK(least > 0.8);
        }
    }
    CHECK(largest_weight < 1.01f);
}

TEST_CASE("A mapped mirror is the limit of a smooth mapped metal") {
    const uint model = GENERATE(NORMAL_MAP_SHADING, NORMAL_MAP_MICROFACET);
    for (const double tilt : {20.0, 40.0, 70.0}) {
        for (const double view : {10.0, 40.0, 65.0}) {
            for (const double azimuth : {0.3, 1.8, 3.0}) {
                const vec3 wo = at_degrees(view, 0.45 + azimuth);
                float largest = 0.0f;
                const double mirror =
                    sampled_albedo(mapped_surface(white_metal(0.0f), tilt, 0.45, model), wo, 20000, 800, largest);
                const double smooth =
                    sampled_albedo(mapped_surface(white_metal(0.0101f), tilt, 0.45, model), wo, 20000, 801, largest);
                INFO("tilt " << tilt << " view " << view << " azimuth " << azimuth << ": " << mirror << ", " << smooth);
                CHECK(std::abs(mirror - smooth) < 0.02);
            }
        }
    }
}

TEST_CASE("No light leaks through the triangle") {
    Uniforms u(34);
    int64_t leaks = 0;
    for (int k = 0; k < 100000; ++k) {
        SurfaceBsdf s = mapped_surface(plastic(u.next()), 80.0 * u.next(), 6.0 * u.next());
        s.shading_normal = direction_at(0.05 + 0.95 * u.next(), 6.0 * u.next());
        s.mapped = static_cast<uint>(k % 3);
        const vec3 wo = direction_at(1.0 - u.next(), 6.0 * u.next());
        const vec3 below = -direction_at(u.next(), 6.0 * u.next());
        const vec2 u_lobe = u.next_pair();
        const BsdfSample r = surface_bsdf_sample(s, wo, u_lobe, u.next_pair(), all_features);
        leaks += r.pdf > 0.0f && r.direction.z <= 0.0f ? 1 : 0;
        leaks += surface_bsdf_pdf(s, wo, below, all_features) > 0.0f ? 1 : 0;
        leaks += surface_bsdf_eval(s, wo, below, all_features).x != 0.0f ? 1 : 0;
        leaks += surface_bsdf_pdf(s, below, wo, all_features) > 0.0f ? 1 : 0;
        leaks += surface_bsdf_sample(s, below, u_lobe, u_lobe, all_features).pdf > 0.0f ? 1 : 0;
    }
    CHECK(leaks == 0);
}

TEST_CASE("A silhouette that sees the triangle but is below the smooth normal's horizon is not black") {
    SurfaceBsdf s = mapped_surface(white_diffuse(), 0.0, 0.0);
    s.shading_normal = at_degrees(30.0, 0.0);
    s.mapped_normal = s.shading_normal;
    for (const uint mapped : {NORMAL_MAP_NONE, NORMAL_MAP_SHADING, NORMAL_MAP_MICROFACET}) {
        s.mapped = mapped;
        for (const double view : {61.0, 75.0, 89.0}) {
            float largest = 0.0f;
            CHECK(sampled_albedo(s, at_degrees(view, M_PI), 4000, 700, largest) > 0.5);
        }
    }
}

TEST_CASE("Degenerate normals and directions give finite values") {
    int64_t bad = 0;
    Uniforms u(35);
    for (const BsdfParameters& p : {plastic(0.0f), plastic(0.02f), white_metal(0.3f), white_diffuse()}) {
        for (const double mapped_cosine : {-1.0, -0.5, 0.0, 1e-6, 1.0 - 1e-7, 1.0}) {
            for (const double smooth_cosine : {0.0, 1e-6, 0.5, 1.0}) {
                for (const double view_cosine : {0.0, 1e-8, 1e-6, 1e-3, 0.5, 1.0}) {
                    for (int k = 0; k < 64; ++k) {
                        SurfaceBsdf s;
                        s.parameters = p;
                        s.geometric_normal = up;
                        s.shading_normal = direction_at(smooth_cosine, k % 4);
                        s.mapped_normal = direction_at(mapped_cosine, k % 3);
                        s.mapped = k % 2 == 0 ? NORMAL_MAP_SHADING : NORMAL_MAP_MICROFACET;
                        const vec3 wo = direction_at(view_cosine, k % 5);
                        const vec2 u_lobe = u.next_pair();
                        const BsdfSample r = surface_bsdf_sample(s, wo, u_lobe, u.next_pair(), all_features);
                        const vec3 f = surface_bsdf_eval(s, wo, r.direction, all_features);
                        const bool ok = r.pdf >= 0.0f && r.pdf < 1e30f && r.weight.x >= -1e-6f && r.weight.x < 1e30f &&
                                        f.x >= -1e-6f && f.x < 1e30f && close(length(r.direction), 1.0, 1e-5);
                        bad += ok ? 0 : 1;
                    }
                }
            }
        }
    }
    CHECK(bad == 0);
}
