// Warps against their pdfs, frames and ray offsets.
#include "numbers/sampling.h"

#include "catch.h"
#include "close.h"
#include "bsdf/frame.h"
#include "geometry/ray_offset.h"
#include "numbers/rng.h"
#include "stats/chi_square.h"

#include <algorithm>
#include <cmath>

using namespace diptych::core::shared;
using diptych::core::chi_square_deviate;
using diptych::core::deviate_limit;
using diptych::core::tests::close;

namespace {

constexpr int draw_count = 1000000;
constexpr int rows = 65;
constexpr int columns = 130;

vec2 random_square(uint i) {
    const uvec4 v = pcg4d(uvec4(i, 17, 23, 42));
    return vec2(unit_float(v.x), unit_float(v.y));
}

std::size_t azimuth_cell(double x, double y) {
    const double turn = std::atan2(y, x) / 6.283185307179586 + 0.5;
    return std::size_t(std::min(turn * columns, columns - 1.0));
}

/// Chi-square in (cos theta, phi); `cumulative(z)` is the probability below height z.
template <typename Warp, typename Cumulative>
double direction_deviate(Warp warp, Cumulative cumulative) {
    std::vector<double> observed(rows * columns);
    std::vector<double> expected(rows * columns);
    double off_unit = 0;
    for (uint i = 0; i < draw_count; i++) {
        const vec3 w = warp(random_square(i));
        off_unit = std::max(off_unit, std::abs(double(length(w)) - 1));
        const auto row = std::size_t(std::min((w.z * 0.5 + 0.5) * rows, rows - 1.0));
        observed[row * columns + azimuth_cell(w.x, w.y)] += 1;
    }
    for (int row = 0; row < rows; row++) {
        const double part = cumulative(2.0 * (row + 1) / rows - 1) - cumulative(2.0 * row / rows - 1);
        for (int column = 0; column < columns; column++) {
            expected[std::size_t(row * columns + column)] = part * draw_count / columns;
        }
    }
    CHECK(off_unit < 1e-6);
    return chi_square_deviate(observed, expected);
}

double above(double z) {
    return std::max(z, 0.0);
}

const float ends[] = {0.0f, 0x1p-24f, 0.5f, 1 - 0x1p-24f};

}  // namespace

TEST_CASE("Directions follow their pdfs") {
    CHECK(std::abs(direction_deviate(sample_cosine_hemisphere, [](double z) { return above(z) * above(z); })) <
          deviate_limit);
    CHECK(std::abs(direction_deviate(sample_uniform_hemisphere, above)) < deviate_limit);
    CHECK(std::abs(direction_deviate(sample_uniform_sphere, [](double z) { return (z + 1) / 2; })) < deviate_limit);
    // The test can tell: the cosine's draws against the uniform pdf.
    CHECK(direction_deviate(sample_cosine_hemisphere, above) > 100);
}

TEST_CASE("Pdfs integrate to 1") {
    double cosine = 0;
    constexpr int steps = 10000;
    for (int i = 0; i < steps; i++) {
        cosine += 2 * 3.141592653589793 / steps * double(pdf_cosine_hemisphere_solid_angle((float(i) + 0.5f) / steps));
    }
    CHECK(close(cosine, 1, 1e-5));
    CHECK(pdf_cosine_hemisphere_solid_angle(-0.5f) == 0);
    CHECK(close(pdf_uniform_hemisphere_solid_angle() * 2 * PI, 1, 1e-6));
    CHECK(close(pdf_uniform_sphere_solid_angle() * 4 * PI, 1, 1e-6));
}

TEST_CASE("The disk is uniform") {
    std::vector<double> cells(64 * columns);
    for (uint i = 0; i < draw_count; i++) {
        const vec2 p = sample_disk_concentric(random_square(i));
        const double squared = double(p.x) * p.x + double(p.y) * p.y;
        REQUIRE(squared < 1 + 1e-6);
        cells[std::size_t(std::min(squared * 64, 63.0)) * columns + azimuth_cell(p.x, p.y)] += 1;
    }
    CHECK(std::abs(diptych::core::uniform_deviate(cells)) < deviate_limit);
}

TEST_CASE("Warps are defined at the ends of u") {
    for (const float x : ends) {
        for (const float y : ends) {
            for (const vec3 w : {sample_cosine_hemisphere(vec2(x, y)), sample_uniform_hemisphere(vec2(x, y)),
                                 sample_uniform_sphere(vec2(x, y))}) {
                CHECK(std::abs(length(w) - 1) < 1e-6f);
            }
            CHECK(length(sample_disk_concentric(vec2(x, y))) <= 1 + 1e-6f);
        }
    }
    CHECK(sample_disk_concentric(vec2(0.5f, 0.5f)) == vec2(0, 0));
}

TEST_CASE("Frames are orthonormal over the sphere and at its poles") {
    double worst = 0;
    double handed = 0;
    double returned = 0;
    auto probe = [&](vec3 n) {
        const Frame f = frame_from_normal(n);
        for (const auto& [a, b] : {std::pair{f.tangent, f.bitangent}, {f.tangent, f.normal}, {f.bitangent, f.normal}}) {
            worst = std::max(worst, std::abs(double(dot(a, b))));
        }
        worst = std::max({worst, std::abs(double(dot(f.tangent, f.tangent)) - 1),
                          std::abs(double(dot(f.bitangent, f.bitangent)) - 1)});
        handed = std::max(handed, double(length(cross(f.tangent, f.bitangent) - n)));
        const vec3 w(0.3f, -0.5f, 0.8f);
        returned = std::max(returned, double(length(to_world(f, to_local(f, w)) - w)));
    };
    for (uint i = 0; i < 300000; i++) {
        probe(normalize(sample_uniform_sphere(random_square(i))));
    }
    for (const float side : {1.0f, -1.0f}) {
        for (float tilt = 1e-30f; tilt < 1; tilt *= 3) {
            probe(normalize(vec3(tilt, -tilt, side)));
            probe(normalize(vec3(1, tilt, side * tilt)));
        }
        probe(vec3(0, 0, side));
        probe(vec3(side, 0, 0));
        probe(vec3(0, side, -0.0f));
    }
    CHECK(worst <= 1e-6);
    CHECK(handed <= 2e-6);
    CHECK(returned <= 2e-6);
    CHECK(to_local(frame_from_normal(vec3(0, 1, 0)), vec3(0, 2, 0)).z == 2);
}

TEST_CASE("offset_ray leaves the surface by little, at every scale") {
    for (float scale = 1e-6f; scale < 2e6f; scale *= 10) {
        for (uint i = 0; i < 2000; i++) {
            const vec3 n = normalize(sample_uniform_sphere(random_square(i)));
            const vec3 p = scale * sample_uniform_sphere(random_square(i + 7777));
            const vec3 moved = offset_ray(p, n, abs(p));
            const double along = double(dot(moved - p, n));
            // Of 64 ulps of the point, which rounding to it may change by one, at least 2 of its largest coordinate.
            REQUIRE(along > 1e-7 * scale);
            REQUIRE(along < 2e-5 * scale);
            const vec3 back = offset_ray(p, -n, abs(p));
            REQUIRE(dot(back - p, n) < 0);
        }
    }
}

TEST_CASE("off_edges moves what lies on an edge, by its margin, and nothing else") {
    const auto is = [](vec2 moved, float x, float y) { return moved.x == x && moved.y == y; };
    CHECK(is(off_edges(vec2(0.25f, 0.5f)), 0.25f, 0.5f));
    CHECK(is(off_edges(vec2(0, 0.5f)), EDGE_MARGIN, 0.5f));
    CHECK(is(off_edges(vec2(0.5f, 0)), 0.5f, EDGE_MARGIN));
    CHECK(is(off_edges(vec2(0.5f, 0.5f)), 0.5f * (1 - EDGE_MARGIN), 0.5f * (1 - EDGE_MARGIN)));
    for (const vec2 corner : {vec2(0, 0), vec2(1, 0), vec2(0, 1)}) {
        const vec2 moved = off_edges(corner);
        CHECK(std::min({moved.x, moved.y, 1 - moved.x - moved.y}) > 0.9f * EDGE_MARGIN);
        CHECK(length(moved - corner) < 3 * EDGE_MARGIN);
    }
}

TEST_CASE("offset_ray's step is 64 ulps of what was added up along the normal, and 2 of the largest") {
    const vec3 sizes(1, 2, 0);
    CHECK(offset_ray(vec3(1, -1, 0), vec3(1, 0, 0), sizes) == vec3(1 + 68 * 0x1p-23f, -1, 0));
    CHECK(offset_ray(vec3(1, -1, 0), vec3(0, 1, 0), sizes) == vec3(1, -1 + 132 * 0x1p-23f, 0));
    CHECK(offset_ray(vec3(1, -1, 0), vec3(0, -1, 0), sizes) == vec3(1, -1 - 132 * 0x1p-23f, 0));
    CHECK(offset_ray(vec3(1, -1, 0), vec3(0, 0, -1), sizes) == vec3(1, -1, -4 * 0x1p-23f));
}
