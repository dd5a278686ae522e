// Microfacets: identities of the distributions, and directional albedo by quadrature against rendered white skies.
#include <cmath>

#include "catch.h"
#include "oracle_fixture.h"

namespace diptych::core::tests {

namespace {

using namespace oracle;

/// Integral over half vectors of weight(h) D(h), by the midpoint rule in the cosine's own distribution: dh D cos = dq
/// dphi / 2 pi.
template <typename Weight>
double over_half_vectors(Distribution model, double alpha, Weight weight) {
    const int n = 2000;
    const int m = 200;
    double sum = 0;
    for (int i = 0; i < n; ++i) {
        // u = 1 - (1 - q)^4 crowds points where h lies flat.
        const double q = (i + 0.5) / n;
        const double cosine = sample_ndf_cosine(model, alpha, 1 - std::pow(1 - q, 4));
        const double width = 4 * std::pow(1 - q, 3);
        for (int j = 0; j < m; ++j) {
            sum += width * weight(from_angles(cosine, 2 * pi * (j + 0.5) / m)) / cosine;
        }
    }
    return sum / n / m;
}

/// f cos over all i: the specular part over half vectors, the diffuse one over directions. Of the shape of the material
/// alone.
dvec3 albedo_by_quadrature(const Bsdf& bsdf, double cos_o) {
    const dvec3 n(0, 0, 1);
    const dvec3 o = from_angles(cos_o, 0.3);
    dvec3 sum(0);
    const int rings = 3000;
    const int sectors = 300;
    for (int i = 0; i < rings; ++i) {
        const double q = (i + 0.5) / rings;
        const double cosine = sample_ndf_cosine(bsdf.model, bsdf.alpha, 1 - std::pow(1 - q, 4));
        const double density = ndf(bsdf.model, bsdf.alpha, cosine, 1 - cosine * cosine) * cosine;
        for (int j = 0; j < sectors; ++j) {
            const dvec3 h = from_angles(cosine, 2 * pi * (j + 0.5) / sectors);
            const dvec3 i_out = 2 * dot(o, h) * h - o;
            if (dot(o, h) > 0 && i_out.z > 0) {
                Bsdf specular = bsdf;
                specular.diffuse = dvec3(0);
                sum += evaluate(specular, n, o, i_out) * (4 * dot(o, h) / density * 4 * std::pow(1 - q, 3));
            }
            Bsdf diffuse = bsdf;
            diffuse.alpha = 0;
            const dvec3 i_diffuse = from_angles(std::sqrt(q), 2 * pi * (j + 0.5) / sectors);
            sum += evaluate(diffuse, n, o, i_diffuse) * (pi / i_diffuse.z);
        }
    }
    return sum / double(rings) / double(sectors);
}

}  // namespace

TEST_CASE("half vectors are drawn with density D cos, which integrates to one", "[oracle]") {
    for (const Distribution model : {Distribution::ggx, Distribution::blinn_phong}) {
        for (const double alpha : {0.01, 0.1, 0.5, 0.9}) {
            INFO((model == Distribution::ggx ? "ggx" : "blinn-phong") << " alpha " << alpha);
            for (const double u : {0.01, 0.3, 0.7, 0.99}) {
                // The share of half vectors nearer to the normal, by the trapezoid rule in the logarithm of tan^2.
                const double end = sample_ndf_cosine(model, alpha, u);
                const double end_tan = 1 / (end * end) - 1;
                const int n = 40000;
                double sum = 0;
                for (int i = 0; i < n; ++i) {
                    const double t = end_tan * std::exp(-40.0 * (i + 0.5) / n);
                    const double cosine = 1 / std::sqrt(1 + t);
                    // d(cos) = cos^3 / 2 dt, dt = t d(log t)
                    sum += 2 * pi * ndf(model, alpha, cosine, t / (1 + t)) * std::pow(cosine, 4) / 2 * t * (40.0 / n);
                }
                CHECK(sum == Approx(u).epsilon(1e-5));
            }
        }
    }
}

TEST_CASE("GGX's masking shows as much of the facets as the surface's own projection", "[oracle]") {
    // Heitz 2014, eq. 21: (1 + Lambda) cos o = integral of [o.h] D(h); Lambda of Blinn-Phong is a fit, of Walter et al.
    // and ours.
    for (const double alpha : {0.05, 0.3, 1.0}) {
        for (const double cosine : {0.1, 0.4, 0.9}) {
            const dvec3 o = from_angles(cosine, 0.2);
            const auto visible = [&](const dvec3& h) { return glm::max(dot(o, h), 0.0); };
            INFO("alpha " << alpha << " cos " << cosine);
            CHECK(cosine * (1 + smith_lambda(Distribution::ggx, alpha, cosine)) ==
                  Approx(over_half_vectors(Distribution::ggx, alpha, visible)).epsilon(2e-3));
            CHECK(cosine * (1 + smith_lambda(Distribution::blinn_phong, alpha, cosine)) ==
                  Approx(over_half_vectors(Distribution::blinn_phong, alpha, visible)).epsilon(0.03));
        }
    }
}

TEST_CASE("under a uniform sky a surface shows its directional albedo", "[oracle]") {
    struct Case {
        float metallic;
        float roughness;
        double cosine;
    };
    const std::vector<Case> cases = {{1, 0.1F, 0.9}, {1, 0.3F, 0.3}, {1, 0.7F, 0.6},    {0, 0.1F, 0.3},
                                     {0, 0.5F, 0.9}, {0, 1, 0.2},    {0.5F, 0.4F, 0.15}};
    for (const Distribution model : {Distribution::ggx, Distribution::blinn_phong}) {
        for (const Case& c : cases) {
            Scene scene;
            const Material material = glossy({0.9F, 0.5F, 0.2F}, c.metallic, c.roughness);
            add_object(scene, "floor",
                       {quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, add_material(scene, material))});
            scene.environment = constant_sky(vec3(1));
            scene.cameras.push_back(narrow_camera(from_angles(c.cosine, 0.3), dvec3(0)));
            Bsdf bsdf;  // glTF 2.0 with an index of refraction of 1.5
            const double m = c.metallic;
            const dvec3 color(material.base_color);
            bsdf.model = model;
            bsdf.alpha = double(c.roughness) * double(c.roughness);
            bsdf.diffuse = color * (1 - m);
            bsdf.f0 = dvec3(0.04) * (1 - m) + color * m;
            bsdf.f90 = 1;
            const dvec3 truth = albedo_by_quadrature(bsdf, c.cosine);
            for (const Mode mode : {Mode::bsdf, Mode::hemisphere}) {
                if (mode == Mode::hemisphere && c.roughness < 0.5F) {
                    continue;  // its variance grows with the highlight
                }
                INFO((model == Distribution::ggx ? "ggx" : "blinn-phong")
                     << ", metallic " << c.metallic << " roughness " << c.roughness << " cos " << c.cosine << ", "
                     << name_of(mode));
                OracleSettings settings = small_settings(4, 4, 1);
                settings.distribution = model;
                settings.mode = mode;
                check_mean(render(scene, settings, mode == Mode::bsdf ? 20000 : 12000).depth(1), truth,
                           mode == Mode::bsdf ? 0.005 : 0.015, 2e-4);
            }
        }
    }
}

TEST_CASE("a mirror shows the sky times its Fresnel term", "[oracle]") {
    Scene scene;
    const Material material = glossy({0.9F, 0.5F, 0.2F}, 1, 0);
    add_object(scene, "floor", {quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, add_material(scene, material))});
    scene.environment = constant_sky({1, 2, 3});
    scene.lights.push_back(point_light({0.1, 0.2, 1}, vec3(1e6F)));  // which a mirror does not show
    const double cosine = 0.4;
    scene.cameras.push_back(narrow_camera(from_angles(cosine, 0.3), dvec3(0)));
    const dvec3 color(material.base_color);
    const dvec3 truth = (color + (1.0 - color) * std::pow(1 - cosine, 5)) * dvec3(1, 2, 3);
    for (const Mode mode : all_modes()) {
        OracleSettings settings = small_settings(2, 2, 1);
        settings.mode = mode;
        check_mean(render(scene, settings, mode == Mode::hemisphere ? 200000 : 4).depth(1), truth);
    }
}

}  // namespace diptych::core::tests
