#include "oracle_fixture.h"

#include <cmath>

#include "catch.h"

namespace diptych::core::tests {

namespace {

Estimate estimate(const dvec3& sum, const dvec3& sum_squares, double n) {
    const dvec3 mean = sum / n;
    return {mean, sqrt(max(sum_squares / n - mean * mean, dvec3(0)) / (n - 1))};
}

}  // namespace

Estimate Rendered::depth(unsigned depth) const {
    dvec3 sum(0);
    dvec3 squares(0);
    double n = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const OracleDepth& part = image.depths[i * (settings.max_depth + 1) + depth];
        sum += part.sum;
        squares += part.sum_squares;
        n += double(image.pixels[i].samples);
    }
    return estimate(sum, squares, n);
}

/// Each pixel has a mean of its own, and the image's mean the errors of all.
Estimate Rendered::all() const {
    dvec3 mean(0);
    dvec3 variance(0);
    for (const OraclePixel& pixel : image.pixels) {
        mean += pixel.mean();
        variance += pixel.variance_of_mean();
    }
    const double count = double(image.pixels.size());
    return {mean / count, sqrt(variance) / count};
}

Rendered render(const Scene& scene, OracleSettings settings, std::uint64_t spp, int threads) {
    const std::atomic<bool> never = false;
    settings.by_depth = true;
    Oracle oracle(scene, settings, threads);
    oracle.render(0, spp, never);
    for (const OraclePixel& pixel : oracle.image().pixels) {
        REQUIRE(pixel.samples == spp);
        REQUIRE(pixel.nonfinite == 0);
    }
    return {settings, oracle.image()};
}

void check_mean(const Estimate& e, const dvec3& truth, double half_width, double systematic) {
    for (int k = 0; k < 3; ++k) {
        INFO("channel " << k << ": " << e.mean[k] << " +- " << e.error[k] << ", truth " << truth[k] << ", ratio "
                        << e.mean[k] / truth[k] << ", z " << (e.mean[k] - truth[k]) / e.error[k]);
        CHECK(1.96 * e.error[k] <= half_width * truth[k]);
        CHECK(std::abs(e.mean[k] - truth[k]) <= z_limit * e.error[k] + systematic * truth[k]);
    }
}

void check_equal(const Estimate& a, const Estimate& b, double half_width) {
    for (int k = 0; k < 3; ++k) {
        const double error = std::hypot(a.error[k], b.error[k]);
        INFO("channel " << k << ": " << a.mean[k] << " +- " << a.error[k] << " and " << b.mean[k] << " +- "
                        << b.error[k] << ", z " << (a.mean[k] - b.mean[k]) / error);
        CHECK(1.96 * error <= half_width * std::abs(b.mean[k]));
        CHECK(std::abs(a.mean[k] - b.mean[k]) <= z_limit * error + 1e-9 * std::abs(b.mean[k]));
    }
}

Material lambertian(const vec3& albedo) {
    Material material = make_material("lambertian", albedo, 0, 1);
    material.specular = 0;
    return material;
}

Material glossy(const vec3& color, float metallic, float roughness) {
    return make_material("glossy", color, metallic, roughness);
}

Primitive quad(const vec3& a, const vec3& b, const vec3& c, const vec3& d, int material) {
    Primitive primitive;
    add_quad(primitive, a, b, c, d);
    primitive.material = material;
    return primitive;
}

Camera narrow_camera(const dvec3& eye, const dvec3& target) {
    return make_camera("narrow", eye, target, 1e-6);
}

OracleSettings small_settings(int width, int height, unsigned max_depth) {
    OracleSettings settings;
    settings.width = width;
    settings.height = height;
    settings.max_depth = max_depth;
    settings.seed = 20;
    return settings;
}

Environment constant_sky(const vec3& radiance) {
    Environment sky;
    sky.kind = EnvironmentKind::constant;
    sky.scale = radiance;
    return sky;
}

PunctualLight point_light(const dvec3& position, const vec3& intensity) {
    PunctualLight light;
    light.light_to_world[3] = glm::dvec4(position, 1);
    light.intensity = intensity;
    return light;
}

double polygon_irradiance(const std::vector<dvec3>& polygon, const dvec3& point, const dvec3& n) {
    double sum = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const dvec3 a = normalize(polygon[i] - point);
        const dvec3 b = normalize(polygon[(i + 1) % polygon.size()] - point);
        sum += std::acos(dot(a, b)) * dot(normalize(cross(a, b)), n);
    }
    return std::abs(sum) / 2;
}

const std::vector<oracle::Mode>& all_modes() {
    static const std::vector<oracle::Mode> modes = {oracle::Mode::mis, oracle::Mode::bsdf, oracle::Mode::hemisphere,
                                                    oracle::Mode::area};
    return modes;
}

const char* name_of(oracle::Mode mode) {
    switch (mode) {
    case oracle::Mode::mis:
        return "mis";
    case oracle::Mode::bsdf:
        return "bsdf";
    case oracle::Mode::hemisphere:
        return "hemisphere";
    default:
        return "area";
    }
}

}  // namespace diptych::core::tests
