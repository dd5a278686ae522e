// Tone maps: known values, monotone, defined for any input.
#include "film/tonemap.h"

#include "catch.h"
#include "close.h"
#include "numbers/rng.h"

#include <algorithm>
#include <cmath>

using namespace diptych::core::shared;
using diptych::core::tests::close;

namespace {

const uint operators[] = {TONEMAP_EXPONENTIAL, TONEMAP_UNCHARTED2, TONEMAP_ACES, TONEMAP_PBR_NEUTRAL};

vec3 gray(float x) {
    return vec3(x, x, x);
}

/// Khronos PBR Neutral as its specification writes it, in double precision.
glm::dvec3 pbr_neutral_in_double(glm::dvec3 color) {
    constexpr double start = 0.8 - 0.04;
    constexpr double room = 1 - start;
    const double least = std::min({color.x, color.y, color.z});
    color -= glm::dvec3(least < 0.08 ? least - 6.25 * least * least : 0.04);
    const double peak = std::max({color.x, color.y, color.z});
    if (peak < start) {
        return color;
    }
    const double new_peak = 1 - room * room / (peak + room - start);
    const double bleached = 1 - 1 / (0.15 * (peak - new_peak) + 1);
    return color * (new_peak / peak) * (1 - bleached) + glm::dvec3(new_peak * bleached);
}

double in_double(uint op, double x) {
    const auto hable = [](double y) {
        return (y * (0.15 * y + 0.1 * 0.5) + 0.2 * 0.02) / (y * (0.15 * y + 0.5) + 0.2 * 0.3) - 0.02 / 0.3;
    };
    switch (op) {
        case TONEMAP_EXPONENTIAL: return 1 - std::exp(-x);
        case TONEMAP_UNCHARTED2: return hable(2 * x) / hable(11.2);
        default: return std::min(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 1.0);
    }
}

}  // namespace

TEST_CASE("Tone maps take black to black and rise") {
    for (const uint op : operators) {
        CAPTURE(op);
        CHECK(std::abs(tonemap(op, gray(0)).x) < 1e-6f);
        float previous = -1;
        for (float x = 0; x < 50; x += 0.01f) {
            const float y = tonemap(op, gray(x)).x;
            REQUIRE(y >= previous - 1e-6f);
            previous = y;
        }
        CHECK(previous > 0.9f);
        CHECK(tonemap(op, gray(0.5f)).x > tonemap(op, gray(0.1f)).x + 0.1f);
    }
}

TEST_CASE("Tone maps have the values of their formulas") {
    CHECK(tonemap(TONEMAP_NONE, vec3(3, -1, 0.5f)) == vec3(3, -1, 0.5f));
    CHECK(close(tonemap(TONEMAP_EXPONENTIAL, gray(1)).y, 1 - std::exp(-1.0), 1e-6));
    CHECK(close(tonemap(TONEMAP_UNCHARTED2, gray(5.6f)).x, 1, 1e-6));  // Hable's white
    CHECK(close(tonemap(TONEMAP_ACES, gray(1)).z, 2.54 / 3.16, 1e-6));
    // PBR Neutral shifts base colours by 0.04 and nothing else ...
    const vec3 shifted = tonemap(TONEMAP_PBR_NEUTRAL, vec3(0.2f, 0.5f, 0.7f));
    CHECK(length(shifted - vec3(0.16f, 0.46f, 0.66f)) < 1e-6f);
    // ... joins at 0.8, and bleaches what is bright.
    CHECK(close(tonemap(TONEMAP_PBR_NEUTRAL, gray(0.8f)).x, 0.76, 1e-5));
    CHECK(close(tonemap(TONEMAP_PBR_NEUTRAL, gray(0.8001f)).x, 0.7601, 1e-5));
    const vec3 bright = tonemap(TONEMAP_PBR_NEUTRAL, vec3(100, 0, 0));
    CHECK(bright.x > 0.99f);
    CHECK(bright.y == bright.z);
    CHECK(bright.y > 0.9f);
}

TEST_CASE("Tone maps are those of double precision, channel by channel") {
    for (uint i = 0; i < 3000; i++) {
        const uvec4 words = pcg4d(uvec4(i, 7, 8, 9));
        const float size = i % 3 == 0 ? 0.2f : i % 3 == 1 ? 1.0f : 12.0f;
        const vec3 color = size * vec3(unit_float(words.x), unit_float(words.y), unit_float(words.z));
        for (const uint op : operators) {
            const vec3 mapped = tonemap(op, color);
            const glm::dvec3 neutral = pbr_neutral_in_double(glm::dvec3(color));
            for (int c = 0; c < 3; c++) {
                CAPTURE(op, c, color[c]);
                const double truth = op == TONEMAP_PBR_NEUTRAL ? neutral[c] : in_double(op, double(color[c]));
                REQUIRE(std::abs(double(mapped[c]) - truth) < 2e-6);
            }
        }
    }
}

TEST_CASE("Tone maps are defined for any input") {
    for (const uint op : operators) {
        for (const float x : {-1.0f, float(INFINITY), -float(INFINITY), float(NAN), 3e38f, 1e-40f}) {
            const vec3 y = tonemap(op, vec3(x, 0.5f, x));
            CAPTURE(op, x);
            CHECK(std::isfinite(y.x));
            CHECK((y.x >= 0 && y.y >= 0 && y.z >= 0));
        }
    }
}

TEST_CASE("The sRGB curve: known values, inverse, clamped") {
    const vec3 encoded = srgb_encode(vec3(0.5f, 0.0031308f, 0.001f));
    CHECK(close(encoded.x, 0.7353569830524495, 1e-6));
    CHECK(close(encoded.y, 0.04045, 1e-4));
    CHECK(close(encoded.z, 0.01292, 1e-6));
    for (int i = 0; i <= 255; i++) {
        const double e = i / 255.0;
        const double linear = e <= 0.04045 ? e / 12.92 : std::pow((e + 0.055) / 1.055, 2.4);
        REQUIRE(std::abs(double(srgb_decode(float(e))) - linear) <= 3e-6 * linear);
        REQUIRE(std::abs(double(srgb_encode(gray(srgb_decode(float(e)))).x) - e) < 1e-6);
    }
    CHECK(srgb_encode(vec3(-1, 2, NAN)) == vec3(0, srgb_encode(gray(1)).x, 0));
    CHECK(close(srgb_encode(gray(1)).x, 1, 1e-6));
}
