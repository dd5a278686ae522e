// The Cornell box against the published data: Cornell University Program of Computer Graphics, "Cornell Box Data".
#include "catch.h"
#include "generate_fixture.h"

#include <array>
#include <cmath>

using namespace diptych::core;
using namespace diptych::core::generate_tests;

namespace {

using Spectrum = std::array<double, 76>;  // at 400, 404, ..., 700 nm

constexpr Spectrum white_reflectance{
    {0.343, 0.445, 0.551, 0.624, 0.665, 0.687, 0.708, 0.723, 0.715, 0.71,  0.745, 0.758, 0.739, 0.767, 0.777, 0.765,
     0.751, 0.745, 0.748, 0.729, 0.745, 0.757, 0.753, 0.75,  0.746, 0.747, 0.735, 0.732, 0.739, 0.734, 0.725, 0.721,
     0.733, 0.725, 0.732, 0.743, 0.744, 0.748, 0.728, 0.716, 0.733, 0.726, 0.713, 0.74,  0.754, 0.764, 0.752, 0.736,
     0.734, 0.741, 0.74,  0.732, 0.745, 0.755, 0.751, 0.744, 0.731, 0.733, 0.744, 0.731, 0.712, 0.708, 0.729, 0.73,
     0.727, 0.707, 0.703, 0.729, 0.75,  0.76,  0.751, 0.739, 0.724, 0.73,  0.74,  0.737}};
constexpr Spectrum green_reflectance{
    {0.092, 0.096, 0.098, 0.097, 0.098, 0.095, 0.095, 0.097, 0.095, 0.094, 0.097, 0.098, 0.096, 0.101, 0.103, 0.104,
     0.107, 0.109, 0.112, 0.115, 0.125, 0.14,  0.16,  0.187, 0.229, 0.285, 0.343, 0.39,  0.435, 0.464, 0.472, 0.476,
     0.481, 0.462, 0.447, 0.441, 0.426, 0.406, 0.373, 0.347, 0.337, 0.314, 0.285, 0.277, 0.266, 0.25,  0.23,  0.207,
     0.186, 0.171, 0.16,  0.148, 0.141, 0.136, 0.13,  0.126, 0.123, 0.121, 0.122, 0.119, 0.114, 0.115, 0.117, 0.117,
     0.118, 0.12,  0.122, 0.128, 0.132, 0.139, 0.144, 0.146, 0.15,  0.152, 0.157, 0.159}};
constexpr Spectrum red_reflectance{
    {0.04,  0.046, 0.048, 0.053, 0.049, 0.05,  0.053, 0.055, 0.057, 0.056, 0.059, 0.057, 0.061, 0.061, 0.06,  0.062,
     0.062, 0.062, 0.061, 0.062, 0.06,  0.059, 0.057, 0.058, 0.058, 0.058, 0.056, 0.055, 0.056, 0.059, 0.057, 0.055,
     0.059, 0.059, 0.058, 0.059, 0.061, 0.061, 0.063, 0.063, 0.067, 0.068, 0.072, 0.08,  0.09,  0.099, 0.124, 0.154,
     0.192, 0.255, 0.287, 0.349, 0.402, 0.443, 0.487, 0.513, 0.558, 0.584, 0.62,  0.606, 0.609, 0.651, 0.612, 0.61,
     0.65,  0.638, 0.627, 0.62,  0.63,  0.628, 0.642, 0.639, 0.657, 0.639, 0.635, 0.642}};

double lobe(double x, double mean, double left, double right) {
    const double t = (x - mean) / (x < mean ? left : right);
    return std::exp(-0.5 * t * t);
}

/// Linear Rec.709 of a spectrum through the multi-lobe fit of the CIE 1931 observer (Wyman, Sloan and Shirley 2013,
/// equation 4).
glm::dvec3 rgb_of(const Spectrum& spectrum) {
    glm::dvec3 xyz(0);
    for (std::size_t i = 0; i < spectrum.size(); ++i) {
        const double l = 400 + 4 * double(i);
        const double x = 1.056 * lobe(l, 599.8, 37.9, 31.0) + 0.362 * lobe(l, 442.0, 16.0, 26.7) -
                         0.065 * lobe(l, 501.1, 20.4, 26.2);
        const double y = 0.821 * lobe(l, 568.8, 46.9, 40.5) + 0.286 * lobe(l, 530.9, 16.3, 31.1);
        const double z = 1.217 * lobe(l, 437.0, 11.8, 36.0) + 0.681 * lobe(l, 459.0, 26.0, 13.8);
        xyz += spectrum[i] * glm::dvec3(x, y, z);
    }
    return {3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
            -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
            0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z};
}

glm::dvec3 balanced_rgb(const Spectrum& spectrum) {
    Spectrum one;
    one.fill(1);
    return rgb_of(spectrum) / rgb_of(one);
}

Spectrum light_spectrum() {
    constexpr std::array<double, 4> knots{0, 8, 15.6, 18.4};  // at 400, 500, 600, 700 nm
    Spectrum out;
    for (std::size_t i = 0; i < out.size(); ++i) {
        const double at = 4 * double(i) / 100;
        const std::size_t left = std::min<std::size_t>(2, std::size_t(at));
        out[i] = knots[left] + (knots[left + 1] - knots[left]) * (at - double(left));
    }
    return out;
}

const Material& material_of(const Scene& scene, const std::string& name) {
    return *world_triangles(scene, find_instance(scene, name)).at(0).material;
}

void check_color(const glm::dvec3& color, const glm::dvec3& expected, double tolerance) {
    for (int i = 0; i < 3; ++i) {
        CHECK(std::abs(color[i] - expected[i]) <= tolerance);
    }
}

/// Every vertex of the object is one of the published millimetres, and each of those is met.
void check_vertices(const Scene& scene, const std::string& name, const std::vector<glm::dvec3>& millimetres) {
    INFO(name);
    std::vector<bool> met(millimetres.size());
    for (const WorldTriangle& triangle : world_triangles(scene, find_instance(scene, name))) {
        for (const glm::dvec3& p : {triangle.a, triangle.b, triangle.c}) {
            bool known = false;
            for (std::size_t i = 0; i < millimetres.size(); ++i) {
                if (glm::length(1000.0 * p - millimetres[i]) < 1e-3) {
                    known = met[i] = true;
                }
            }
            CHECK(known);
        }
    }
    for (const bool one : met) {
        CHECK(one);
    }
}

}  // namespace

TEST_CASE("cornell has the published colours", "[generate]") {
    const Scene scene = generate_scene("cornell").scene;
    check_color(material_of(scene, "floor").base_color, balanced_rgb(white_reflectance), 6e-5);
    check_color(material_of(scene, "tall block").base_color, balanced_rgb(white_reflectance), 6e-5);
    check_color(material_of(scene, "left wall").base_color, balanced_rgb(red_reflectance), 6e-5);
    check_color(material_of(scene, "right wall").base_color, balanced_rgb(green_reflectance), 6e-5);
    check_color(material_of(scene, "light").emission, balanced_rgb(light_spectrum()), 5e-3);
    check_color(material_of(scene, "light").base_color, glm::dvec3(0.78), 1e-6);
    for (const Material& material : scene.materials) {
        CHECK(material.metallic == 0);
        CHECK(material.specular == 0);
    }
}

TEST_CASE("cornell has the published vertices", "[generate]") {
    const Scene scene = generate_scene("cornell").scene;
    check_vertices(scene, "floor", {{552.8, 0, 0}, {0, 0, 0}, {0, 0, 559.2}, {549.6, 0, 559.2}});
    check_vertices(scene, "light", {{343, 548.8, 227}, {343, 548.8, 332}, {213, 548.8, 332}, {213, 548.8, 227}});
    check_vertices(scene, "ceiling",
                   {{556, 548.8, 0},
                    {556, 548.8, 559.2},
                    {0, 548.8, 559.2},
                    {0, 548.8, 0},
                    {343, 548.8, 227},
                    {343, 548.8, 332},
                    {213, 548.8, 332},
                    {213, 548.8, 227}});
    check_vertices(scene, "back wall", {{549.6, 0, 559.2}, {0, 0, 559.2}, {0, 548.8, 559.2}, {556, 548.8, 559.2}});
    check_vertices(scene, "right wall", {{0, 0, 559.2}, {0, 0, 0}, {0, 548.8, 0}, {0, 548.8, 559.2}});
    check_vertices(scene, "left wall", {{552.8, 0, 0}, {549.6, 0, 559.2}, {556, 548.8, 559.2}, {556, 548.8, 0}});
    check_vertices(scene, "short block",
                   {{130, 165, 65},
                    {82, 165, 225},
                    {240, 165, 272},
                    {290, 165, 114},
                    {130, 0, 65},
                    {82, 0, 225},
                    {240, 0, 272},
                    {290, 0, 114}});
    check_vertices(scene, "tall block",
                   {{423, 330, 247},
                    {265, 330, 296},
                    {314, 330, 456},
                    {472, 330, 406},
                    {423, 0, 247},
                    {265, 0, 296},
                    {314, 0, 456},
                    {472, 0, 406}});
    const Camera& camera = scene.cameras.at(0);
    CHECK(glm::length(glm::dvec3(camera.camera_to_world[3]) - glm::dvec3(0.278, 0.273, -0.8)) < 1e-12);
    CHECK(glm::length(glm::dvec3(camera.camera_to_world[2]) - glm::dvec3(0, 0, -1)) < 1e-12);
    CHECK(std::abs(std::tan(camera.vertical_fov / 2) - 0.0125 / 0.035) < 1e-8);
}

TEST_CASE("cornell's ceiling and light together cover the top once, and all faces look inwards", "[generate]") {
    const Scene scene = generate_scene("cornell").scene;
    double covered = 0;
    for (const char* name : {"ceiling", "light"}) {
        for (const WorldTriangle& triangle : world_triangles(scene, find_instance(scene, name))) {
            CHECK(triangle.area_vector().y < 0);
            covered -= triangle.area_vector().y;
        }
    }
    CHECK(std::abs(covered - 0.556 * 0.5592) < 1e-7);

    const glm::dvec3 middle(0.278, 0.274, 0.28);
    for (const char* name : {"floor", "back wall", "left wall", "right wall"}) {
        for (const WorldTriangle& triangle : world_triangles(scene, find_instance(scene, name))) {
            CHECK(glm::dot(triangle.area_vector(), middle - triangle.center()) > 0);
        }
    }
    for (const char* name : {"short block", "tall block"}) {
        const auto triangles = world_triangles(scene, find_instance(scene, name));
        glm::dvec3 center(0);
        for (const WorldTriangle& triangle : triangles) {
            center += triangle.center() / double(triangles.size());
        }
        for (const WorldTriangle& triangle : triangles) {
            CHECK(glm::dot(triangle.area_vector(), triangle.center() - center) > 0);
        }
    }
}
