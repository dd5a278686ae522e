// Light from infinity: directional albedos under a uniform sky, and maps with a sun in them.
#include <numbers>

#include "render_fixture.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

constexpr double pi = std::numbers::pi;

Scene floor_under_sky(const Material& material, const glm::dvec3& eye) {
    Scene scene;
    scene.name = "floor";
    const int floor = add_material(scene, material);
    add_object(scene, "floor", {horizontal_square(glm::vec3(0), 20, true, floor)});
    scene.cameras.push_back(point_camera(eye, {0, 0, 0}));
    scene.environment.kind = Environment::Kind::constant;
    scene.environment.scale = {1, 0.5F, 2};
    return scene;
}

void check_albedo(const Scene& scene, double albedo, RenderSettings settings, std::uint32_t spp) {
    const Rgb truth = {albedo, 0.5 * albedo, 2 * albedo};
    for (const Integrator integrator : integrators) {
        settings.integrator = integrator;
        const ImageMean m = image_mean(render_cpu(scene, settings, spp));
        INFO(name_of(integrator) << ": " << describe(m) << "truth " << albedo);
        CHECK(m.nonfinite == 0);
        CHECK(relative_error(m, exactly(truth)) < 2e-3);
        CHECK(worst_z(m, exactly(truth)) < 4.5);
    }
}

/// Reflected share of uniform light by a GGX mirror-coloured surface (F = 1), in double: the integral over half vectors
/// of D G2 (o.h) / (o.n), which is f cos over directions with the Jacobian 4 (o.h) taken in. Height-correlated Smith.
double ggx_white_albedo(double alpha, double cos_o) {
    const double sin_o = std::sqrt(1 - cos_o * cos_o);
    const auto lambda = [&](double cosine) {
        const double tan2 = (1 - cosine * cosine) / (cosine * cosine);
        return 0.5 * (std::sqrt(1 + alpha * alpha * tan2) - 1);
    };
    constexpr int n = 1500;
    double sum = 0;
    for (int i = 0; i < n; ++i) {
        // By the distribution of tan, so that the peak is resolved: D cos dw = du dphi / 2 pi.
        const double u = (i + 0.5) / n;
        const double tan2 = alpha * alpha * u / (1 - u);
        const double cos_h = 1 / std::sqrt(1 + tan2);
        const double sin_h = std::sqrt(1 - cos_h * cos_h);
        for (int j = 0; j < n; ++j) {
            const double phi = 2 * pi * (j + 0.5) / n;
            const double o_dot_h = sin_o * sin_h * std::cos(phi) + cos_o * cos_h;
            const double cos_i = 2 * o_dot_h * cos_h - cos_o;
            if (o_dot_h > 0 && cos_i > 0) {
                sum += o_dot_h / (cos_o * cos_h * (1 + lambda(cos_o) + lambda(cos_i)));
            }
        }
    }
    return sum / n / n;
}

}  // namespace

TEST_CASE("A diffuse plane under a uniform sky reflects its albedo") {
    check_albedo(floor_under_sky(diffuse_material(0.6F), {0.6, 0.4, 0.3}), 0.6,
                 statistical_settings(16, 16, Integrator::path, 1), 2048);
}

TEST_CASE("Rough white metal under a uniform sky reflects GGX's directional albedo") {
    for (const auto& [roughness, cosine] : {std::pair(0.6F, 0.3), {0.8F, 0.6}, {1.0F, 0.9}}) {
        Material metal = make_material("metal", glm::vec3(1), 1, roughness);
        const glm::dvec3 eye = glm::dvec3(std::sqrt(1 - cosine * cosine), cosine, 0) * 0.7;
        const double albedo = ggx_white_albedo(static_cast<double>(roughness) * roughness, cosine);
        INFO("roughness " << roughness << " cosine " << cosine << " albedo " << albedo);
        CHECK(albedo < 1);
        // Light sampling finds a narrow lobe rarely.
        check_albedo(floor_under_sky(metal, eye), albedo, statistical_settings(16, 16, Integrator::path, 1),
                     roughness < 0.7F ? 6144 : 2048);
    }
}

TEST_CASE("A perfect mirror shows the sky by its Fresnel factor") {
    const Material mirror = make_material("mirror", glm::vec3(0.8F), 1, 0);
    const double cosine = 0.5;
    const double fresnel = 0.8 + 0.2 * std::pow(1 - cosine, 5);
    for (const BrdfModel brdf : brdf_models) {
        RenderSettings settings = statistical_settings(8, 8, Integrator::path, 1);
        settings.brdf = brdf;
        check_albedo(floor_under_sky(mirror, {std::sqrt(0.75), 0.5, 0}), fresnel, settings, 64);
    }
}

TEST_CASE("Maps are oriented and turned as promised") {
    // Row 0 is +Y, the centre looks along -Z, and u grows toward +X; a turn is counter-clockwise about +Y seen from
    // above.
    Scene scene;
    scene.name = "sky";
    Environment& e = scene.environment;
    e.kind = Environment::Kind::map;
    e.width = 8;
    e.height = 4;
    e.texels.assign(32, glm::vec3(0));
    e.texels[8 + 6] = glm::vec3(1, 0, 0);   // u = 6.5/8: 135 degrees right of -Z, above the horizon
    e.texels[16 + 4] = glm::vec3(0, 1, 0);  // u = 4.5/8, below
    const auto look = [&](double right_of_forward, double polar) {
        const double a = right_of_forward;
        const glm::dvec3 d(std::sin(polar) * std::sin(a), std::cos(polar), -std::sin(polar) * std::cos(a));
        scene.cameras = {point_camera({0, 0, 0}, d)};
        return image_mean(render_cpu(scene, statistical_settings(2, 2, Integrator::path, 0), 2)).mean;
    };
    const double red = 2 * pi * (6.5 / 8 - 0.5);
    const double green = 2 * pi * (4.5 / 8 - 0.5);
    CHECK(look(red, pi * 1.5 / 4)[0] == Approx(1).epsilon(1e-3));
    CHECK(look(green, pi * 2.5 / 4)[1] == Approx(1).epsilon(1e-3));
    CHECK(look(green, pi * 1.5 / 4)[1] == Approx(0).margin(1e-3));
    CHECK(look(red, pi * 2.0 / 4)[0] == Approx(0.5).epsilon(1e-3));  // bilinear, half way to black
    e.rotation = pi / 2;  // counter-clockwise seen from above: what stood at -Z is at -X now
    CHECK(look(red - pi / 2, pi * 1.5 / 4)[0] == Approx(1).epsilon(1e-3));
    e.scale = {3, 1, 1};
    CHECK(look(red - pi / 2, pi * 1.5 / 4)[0] == Approx(3).epsilon(1e-3));
}

TEST_CASE("The seam of a map is no edge") {
    Scene scene;
    scene.name = "sky";
    scene.environment = sunny_sky(8, 4, 1);
    scene.environment.texels[8 + 0] = glm::vec3(2);
    scene.environment.texels[8 + 7] = glm::vec3(4);
    scene.cameras = {point_camera({0, 0, 0}, {0, std::cos(pi * 1.5 / 4), std::sin(pi * 1.5 / 4)})};
    const ImageMean m = image_mean(render_cpu(scene, statistical_settings(8, 8, Integrator::path, 0), 4));
    CHECK(m.mean[0] == Approx(3).epsilon(1e-3));
}

TEST_CASE("A floor under a map receives what quadrature says, by all three integrators") {
    Scene scene = floor_under_sky(diffuse_material(0.5F), {0.6, 0.4, 0.3});
    scene.environment = sunny_sky(16, 8, 30);
    scene.environment.rotation = 1;
    // E = sum over a fine grid of the bilinear map times cos times solid angle.
    const Environment& e = scene.environment;
    Rgb truth{};
    constexpr int n = 1024;
    for (int j = 0; j < n / 2; ++j) {
        const double polar = pi * (j + 0.5) / n;
        for (int i = 0; i < n; ++i) {
            const double x = (i + 0.5) / n * e.width - 0.5;
            const double y = (j + 0.5) / n * e.height - 0.5;
            const int x0 = static_cast<int>(std::floor(x));
            const int y0 = static_cast<int>(std::floor(y));
            const auto texel = [&](int a, int b) {
                const int column = (a + e.width) % e.width;
                const int row = std::min(std::max(b, 0), e.height - 1);
                return glm::dvec3(e.texels[static_cast<std::size_t>(row * e.width + column)]);
            };
            const double s = x - x0;
            const double t = y - y0;
            const glm::dvec3 radiance = (1 - t) * ((1 - s) * texel(x0, y0) + s * texel(x0 + 1, y0)) +
                                        t * ((1 - s) * texel(x0, y0 + 1) + s * texel(x0 + 1, y0 + 1));
            for (int c = 0; c < 3; ++c) {
                truth[static_cast<std::size_t>(c)] +=
                    radiance[c] * std::cos(polar) * std::sin(polar) * (pi / n) * (2 * pi / n) * 0.5 / pi;
            }
        }
    }
    for (const Integrator integrator : integrators) {
        const std::uint32_t spp = integrator == Integrator::brdf ? 12288 : 1792;
        const ImageMean m = image_mean(render_cpu(scene, statistical_settings(16, 16, integrator, 1), spp));
        INFO(name_of(integrator) << ": " << describe(m) << "truth " << describe(exactly(truth)));
        CHECK(m.nonfinite == 0);
        CHECK(relative_error(m, exactly(truth)) < 2e-3);
        CHECK(worst_z(m, exactly(truth)) < 4.5);
    }
}
