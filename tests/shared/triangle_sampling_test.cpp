// Triangles as lights: solid angle against fp64, and samples against the pdf that they claim.
#include "numbers/triangle_sampling.h"

#include "catch.h"
#include "numbers/rng.h"
#include "numbers/sampling.h"
#include "stats/chi_square.h"

#include <cmath>

using namespace diptych::core::shared;
using diptych::core::chi_square_deviate;
using diptych::core::deviate_limit;

namespace {

using dvec3 = glm::dvec3;

struct Triangle {
    vec3 v0;
    vec3 e1;
    vec3 e2;
};

vec2 random_square(uint i, uint stream) {
    const uvec4 v = pcg4d(uvec4(i, stream, 5, 6));
    return vec2(unit_float(v.x), unit_float(v.y));
}

vec3 random_vector(uint i, uint stream) {
    const uvec4 v = pcg4d(uvec4(i, stream, 77, 1));
    return vec3(unit_float(v.x), unit_float(v.y), unit_float(v.z)) * 2.0f - 1.0f;
}

/// In double, by the edges' determinant.
double exact_solid_angle(vec3 reference, const Triangle& t) {
    const dvec3 a = dvec3(t.v0) - dvec3(reference);
    const dvec3 b = a + dvec3(t.e1), c = a + dvec3(t.e2);
    const double volume = std::abs(glm::dot(a, glm::cross(dvec3(t.e1), dvec3(t.e2))));
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    return 2 * std::atan2(volume, la * lb * lc + glm::dot(a, b) * lc + glm::dot(a, c) * lb + glm::dot(b, c) * la);
}

vec3 point_at(const Triangle& t, vec2 barycentrics) {
    return t.v0 + barycentrics.x * t.e1 + barycentrics.y * t.e2;
}

/// The solid angle's share per area, at a point: |cos|/r^2.
double projected(vec3 reference, const Triangle& t, dvec3 point) {
    const dvec3 to = point - dvec3(reference);
    const dvec3 n = glm::normalize(glm::cross(dvec3(t.e1), dvec3(t.e2)));
    const double r2 = glm::dot(to, to);
    return std::abs(glm::dot(to, n)) / (r2 * std::sqrt(r2));
}

bool inside(vec2 b) {
    return b.x >= 0 && b.y >= 0 && b.x + b.y <= 1 + 1e-6f;
}

const float u_ends[] = {0.0f, 0x1p-24f, 0.5f, 1 - 0x1p-24f};
const vec3 origin(0, 0, 0);

/// Chi-square of samples over cells of the square that sample_triangle maps to the triangle; cells of equal area there.
double sample_deviate(vec3 reference, const Triangle& t, bool against_area) {
    constexpr int cells = 24, fine = 12, draws = 400000;
    std::vector<double> expected(cells * cells), observed(cells * cells);
    double total = 0;
    for (int i = 0; i < cells * fine; i++) {
        for (int j = 0; j < cells * fine; j++) {
            // Rows and columns of parallelograms, those beyond the diagonal left out by their midpoint's weight.
            const double x = (i + 0.5) / (cells * fine), y = (j + 0.5) / (cells * fine);
            // A triangle's corner cell: sqrt map, area-preserving.
            const double root = std::sqrt(x), b1 = 1 - root, b2 = y * root;
            const dvec3 point = dvec3(t.v0) + b1 * dvec3(t.e1) + b2 * dvec3(t.e2);
            const double weight = against_area ? 1 : projected(reference, t, point);
            expected[std::size_t((i / fine) * cells + j / fine)] += weight;
            total += weight;
        }
    }
    for (uint k = 0; k < draws; k++) {
        const TriangleSample s = sample_triangle_solid_angle(reference, t.v0, t.e1, t.e2, random_square(k, 9));
        const double root = 1 - double(s.barycentrics.x);
        const double y = root > 0 ? s.barycentrics.y / root : 0;
        const auto i = std::size_t(std::min(root * root * cells, cells - 1.0));
        const auto j = std::size_t(std::min(y * cells, cells - 1.0));
        observed[i * cells + j] += 1;
    }
    for (double& e : expected) {
        e *= draws / total;
    }
    return chi_square_deviate(observed, expected);
}

}  // namespace

TEST_CASE("sample_triangle is uniform and stays inside at the ends of u") {
    for (const float x : u_ends) {
        for (const float y : u_ends) {
            const vec2 b = sample_triangle(vec2(x, y));
            CHECK((b.x >= 0 && b.y >= 0 && b.x + b.y < 1));
        }
    }
    std::vector<double> cells(32 * 32);
    for (uint i = 0; i < 500000; i++) {
        const vec2 b = sample_triangle(random_square(i, 3));
        const double root = 1 - double(b.x);
        cells[std::size_t(std::min(root * root * 32, 31.0)) * 32 + std::size_t(std::min(b.y / root * 32, 31.0))] += 1;
    }
    CHECK(std::abs(diptych::core::uniform_deviate(cells)) < deviate_limit);
}

TEST_CASE("Solid angles agree with fp64 from 1e-10 sr to 2 pi") {
    double worst_small = 0, least = 10, largest = 0;
    for (uint i = 0; i < 200000; i++) {
        const float size = std::pow(10.0f, -5.0f + 6.0f * unit_float(hash_combine(i, 1)));
        const Triangle t{random_vector(i, 0) + vec3(0, 0, 2), random_vector(i, 1) * size, random_vector(i, 2) * size};
        const double truth = exact_solid_angle(origin, t);
        // Edge-on or nearly degenerate triangles: the inputs' rounding bounds what any fp32 formula can do.
        const dvec3 n = glm::cross(dvec3(t.e1), dvec3(t.e2));
        const double sine = glm::length(n) / (glm::length(dvec3(t.e1)) * glm::length(dvec3(t.e2)));
        const double facing = std::abs(glm::dot(glm::normalize(n), glm::normalize(dvec3(t.v0))));
        if (truth < 1e-11 || sine < 0.1 || facing < 0.1) {
            continue;
        }
        least = std::min(least, truth);
        largest = std::max(largest, truth);
        const double error = std::abs(double(solid_angle_triangle(origin, t.v0, t.e1, t.e2)) - truth) / truth;
        worst_small = std::max(worst_small, error);
    }
    CAPTURE(least, largest);
    CHECK(worst_small < 1e-5);
    CHECK(least < 1e-10);
    CHECK(largest > 4);
    // A huge triangle close by: the half space.
    const Triangle plane{vec3(-1000, -1000, 1e-3f), vec3(3000, 0, 0), vec3(0, 3000, 0)};
    CHECK(std::abs(solid_angle_triangle(origin, plane.v0, plane.e1, plane.e2) - exact_solid_angle(origin, plane)) <
          1e-5);
    CHECK(exact_solid_angle(origin, plane) > 6.28);
}

TEST_CASE("Needles of 1e6 to 1 keep their solid angle, whichever edge is short") {
    const vec3 at(0, 0.1f, 2), along = vec3(1, 0.3f, 0.2f), across = 1e-6f * vec3(-0.3f, 1, 0.1f);
    for (const Triangle& t : {Triangle{at, along, across}, Triangle{at, across, along},
                              Triangle{at, along, along + across}, Triangle{at + along, -along, across - along}}) {
        const double truth = exact_solid_angle(origin, t);
        CHECK(std::abs(double(solid_angle_triangle(origin, t.v0, t.e1, t.e2)) - truth) < 1e-4 * truth);
    }
}

TEST_CASE("Solid angles and pdfs do not depend on the scene's scale") {
    for (const float scale : {1e-12f, 1e-6f, 1e6f, 1e15f}) {
        const Triangle t{vec3(0, 0, 2) * scale, vec3(1, 0, 0) * scale, vec3(0, 1, 0.5f) * scale};
        CHECK(std::abs(solid_angle_triangle(origin, t.v0, t.e1, t.e2) -
                       exact_solid_angle(origin, {vec3(0, 0, 2), vec3(1, 0, 0), vec3(0, 1, 0.5f)})) < 1e-6);
    }
}

TEST_CASE("Samples have the density that they claim, on both branches") {
    const Triangle lamp{vec3(-0.5f, -0.4f, 1), vec3(1.1f, 0.1f, 0.2f), vec3(0.2f, 0.9f, -0.3f)};
    REQUIRE(solid_angle_triangle(origin, lamp.v0, lamp.e1, lamp.e2) > 0.1f);
    CHECK(std::abs(sample_deviate(origin, lamp, false)) < deviate_limit);
    CHECK(sample_deviate(origin, lamp, true) > 20);  // the test tells one from the other
    const Triangle tilted{vec3(-1, -0.2f, 0.1f), vec3(2, 0, 0.3f), vec3(0.3f, 0.2f, 1.5f)};
    CHECK(std::abs(sample_deviate(origin, tilted, false)) < deviate_limit);
    const Triangle small{vec3(0.3f, 0.2f, 1), vec3(0.03f, 0, 0), vec3(0, 0.03f, 0.02f)};
    const float small_angle = solid_angle_triangle(origin, small.v0, small.e1, small.e2);
    REQUIRE((small_angle > SPHERICAL_TRIANGLE_MIN && small_angle < 2 * SPHERICAL_TRIANGLE_MIN));
    CHECK(std::abs(sample_deviate(origin, small, false)) < deviate_limit);
    const Triangle sliver{vec3(-1, 0.5f, 1), vec3(2, 0, 0), vec3(2, 2e-3f, 0)};
    REQUIRE(solid_angle_triangle(origin, sliver.v0, sliver.e1, sliver.e2) > SPHERICAL_TRIANGLE_MIN);
    CHECK(std::abs(sample_deviate(origin, sliver, false)) < deviate_limit);
    const Triangle far{vec3(-0.5f, -0.4f, 100), vec3(1.1f, 0.1f, 0.2f), vec3(0.2f, 0.9f, -0.3f)};
    REQUIRE(solid_angle_triangle(origin, far.v0, far.e1, far.e2) < SPHERICAL_TRIANGLE_MIN);
    CHECK(std::abs(sample_deviate(origin, far, true)) < deviate_limit);
}

TEST_CASE("Sample and pdf agree, and 1/pdf averages to the solid angle") {
    uint spherical = 0, flat = 0;
    double worst = 0;
    for (uint i = 0; i < 3000; i++) {
        const float size = std::pow(10.0f, -3.0f + 4.0f * unit_float(hash_combine(i, 2)));
        const Triangle t{random_vector(i, 0) + vec3(0, 0, 1.2f), random_vector(i, 1) * size,
                         random_vector(i, 2) * size};
        const double truth = exact_solid_angle(origin, t);
        const dvec3 n = glm::cross(dvec3(t.e1), dvec3(t.e2));
        const double sine = glm::length(n) / (glm::length(dvec3(t.e1)) * glm::length(dvec3(t.e2)));
        if (sine < 0.01 || std::abs(glm::dot(glm::normalize(n), glm::normalize(dvec3(t.v0)))) < 0.01) {
            continue;
        }
        const bool by_angle = truth >= SPHERICAL_TRIANGLE_MIN && truth <= SPHERICAL_TRIANGLE_MAX;
        (by_angle ? spherical : flat)++;
        double sum = 0;
        constexpr uint count = 64;
        for (uint k = 0; k < count * count; k++) {
            const vec2 u((float(k % count) + 0.5f) / count, (float(k / count) + 0.5f) / count);
            if (k % 256 != 0 && !(by_angle == false && i % 16 == 0)) {
                continue;
            }
            const TriangleSample s = sample_triangle_solid_angle(origin, t.v0, t.e1, t.e2, u);
            REQUIRE(inside(s.barycentrics));
            REQUIRE(s.pdf > 0);
            const float pdf = pdf_triangle_solid_angle(origin, t.v0, t.e1, t.e2, point_at(t, s.barycentrics));
            worst = std::max(worst, std::abs(double(pdf) / double(s.pdf) - 1));
            sum += 1 / double(s.pdf) / (count * count);
        }
        if (!by_angle && i % 16 == 0 && truth < 1) {
            CHECK(std::abs(sum / truth - 1) < 1e-3);
        }
    }
    CAPTURE(spherical, flat);
    CHECK(worst < 1e-3);
    CHECK(spherical > 500);
    CHECK(flat > 200);
}

TEST_CASE("The pdf integrates to 1 over the directions to the triangle") {
    const Triangle t{vec3(-0.5f, -0.4f, 1), vec3(1.1f, 0.1f, 0.2f), vec3(0.2f, 0.9f, -0.3f)};
    for (const float height : {0.0f, -60.0f}) {  // spherical, then by area
        const vec3 reference(0, 0, height);
        const double area = 0.5 * glm::length(glm::cross(dvec3(t.e1), dvec3(t.e2)));
        double sum = 0;
        constexpr int steps = 300;
        for (int k = 0; k < steps * steps; k++) {
            const vec2 b = sample_triangle(vec2((float(k % steps) + 0.5f) / steps, (float(k / steps) + 0.5f) / steps));
            const vec3 point = point_at(t, b);
            sum += double(pdf_triangle_solid_angle(reference, t.v0, t.e1, t.e2, point)) *
                   projected(reference, t, dvec3(point)) * area / (steps * steps);
        }
        CHECK(std::abs(sum - 1) < 1e-3);
    }
}

TEST_CASE("No NaN at the ends of u, on needles, from within the plane, or for no triangle at all") {
    const vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    const Triangle triangles[] = {
        {z, x, y},
        {z * 1e-3f, x, y},
        {z, x, 1e-6f * y},
        {z, 1e-6f * x, y},
        {z, x, x + 1e-6f * y},
        {z - x * 5.0f, x * 10.0f, x * 5.0f + y * 1e-3f},
        {-x * 2000.0f - y * 1000.0f + 1e-3f * z, x * 4000.0f, y * 4000.0f},
        {z, x, x},
        {z, x, -x},
        {z, origin, y},
        {z, origin, origin},
        {origin, origin, origin},
        {origin, x, y},
        {x, y, z},
        {x * 1e-20f, y * 1e-20f, z * 1e-20f},
        {-x - y, x * 4.0f, y * 4.0f},
        {-x, x * 2.0f, x + y},  // from an edge, where volume and denominator are both exactly 0
        {x + y, x, y},
    };
    for (const Triangle& t : triangles) {
        const double truth = exact_solid_angle(origin, t);
        for (const float u_x : u_ends) {
            for (const float u_y : u_ends) {
                const TriangleSample s = sample_triangle_solid_angle(origin, t.v0, t.e1, t.e2, vec2(u_x, u_y));
                CAPTURE(t.v0.x, t.v0.y, t.v0.z, t.e1.x, t.e1.y, t.e1.z, t.e2.x, t.e2.y, t.e2.z, u_x, u_y);
                REQUIRE(inside(s.barycentrics));
                REQUIRE(std::isfinite(s.pdf));
                REQUIRE(s.pdf >= 0);
                const float pdf = pdf_triangle_solid_angle(origin, t.v0, t.e1, t.e2, point_at(t, s.barycentrics));
                REQUIRE(std::isfinite(pdf));
                const double area = glm::length(glm::cross(dvec3(t.e1), dvec3(t.e2)));
                const bool in_plane = glm::dot(dvec3(t.v0), glm::cross(dvec3(t.e1), dvec3(t.e2))) == 0;
                if (area == 0 || in_plane) {
                    REQUIRE(s.pdf == 0);
                    REQUIRE(pdf == 0);
                } else if (truth > 1e-3) {
                    REQUIRE(s.pdf > 0);
                }
            }
        }
    }
}
