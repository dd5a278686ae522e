// Elementary functions against double, at the bounds that their docstrings state.
#include "numbers/elementary.h"

#include "catch.h"
#include "close.h"
#include "known_values.h"

#include <cmath>

using namespace diptych::core::shared;
using namespace diptych::core::tests;

namespace {

double ulp(double x) {
    return std::ldexp(1.0, std::max(std::ilogb(std::max(std::abs(x), 1.2e-38)), -126) - 23);
}

struct Error {
    double ulps = 0;
    double absolute = 0;
};

/// Largest error over evenly spaced arguments and over arguments of every size.
template <typename Approximate, typename Exact>
Error largest_error(float low, float high, Approximate approximate, Exact exact) {
    Error worst;
    auto probe = [&](float x) {
        if (x < low || x > high) {
            return;
        }
        const double truth = exact(double(x));
        const double error = std::abs(double(approximate(x)) - truth);
        worst.ulps = std::max(worst.ulps, std::isfinite(error) ? error / ulp(truth) : INFINITY);
        worst.absolute = std::max(worst.absolute, error);
    };
    constexpr int steps = 1000000;
    for (int i = 0; i <= steps; i++) {
        probe(float(double(low) + (double(high) - double(low)) * i / steps));
    }
    for (uint bits = 0x00800000u; bits < 0x7f800000u; bits += 2003u) {
        probe(uintBitsToFloat(bits));
        probe(-uintBitsToFloat(bits));
    }
    return worst;
}

const float infinity = positive_infinity();
const float not_a_number = uintBitsToFloat(0x7fc00000u);

}  // namespace

TEST_CASE("sin_cos keeps its bounds") {
    const auto exact_sine = [](double x) { return std::sin(x); };
    const auto exact_cosine = [](double x) { return std::cos(x); };
    CHECK(largest_error(-7, 7, sine, exact_sine).ulps <= 1.6);
    CHECK(largest_error(-7, 7, cosine, exact_cosine).ulps <= 1.6);
    CHECK(largest_error(-SIN_COS_MAX, SIN_COS_MAX, sine, exact_sine).absolute <= 3e-7);
    CHECK(largest_error(-SIN_COS_MAX, SIN_COS_MAX, cosine, exact_cosine).absolute <= 3e-7);
    for (const float x : {1e9f, -3e38f, infinity, -infinity, not_a_number}) {
        CHECK(sine(x) == 0);
        CHECK(cosine(x) == 1);
    }
}

TEST_CASE("arctan2 keeps its bounds in every quadrant") {
    for (const float other : {1.0f, -1.0f, 0.3f, -1e-3f, 1e5f}) {
        const double fixed = other;
        CHECK(largest_error(
                  -3, 3, [=](float y) { return arctan2(y, other); }, [=](double y) { return std::atan2(y, fixed); })
                  .ulps <= 2.6);
        CHECK(largest_error(
                  -3, 3, [=](float x) { return arctan2(other, x); }, [=](double x) { return std::atan2(fixed, x); })
                  .ulps <= 2.6);
    }
    CHECK(arctan2(0, 0) == 0);
    CHECK(arctan2(0, -1) == PI);
    CHECK(arctan2(-1, 0) == -HALF_PI);
    CHECK(arctan2(1e-30f, 1e-30f) == QUARTER_PI);
    CHECK(arctan2(1e38f, -1e38f) == 3 * QUARTER_PI);
}

TEST_CASE("arccos keeps its bound") {
    CHECK(largest_error(-1, 1, arccos, [](double x) { return std::acos(x); }).ulps <= 3.4);
    CHECK(arccos(1) == 0);
    CHECK(arccos(-1) == PI);
    CHECK(arccos(1.5f) == 0);
    CHECK(arccos(-1.5f) == PI);
}

TEST_CASE("exp2_poly and log2_poly keep their bounds") {
    CHECK(largest_error(-126, 127.9999f, exp2_poly, [](double x) { return std::exp2(x); }).ulps <= 1.6);
    CHECK(exp2_poly(0) == 1);
    CHECK(exp2_poly(-3) == 0.125f);
    CHECK(exp2_poly(128) == infinity);
    CHECK(exp2_poly(infinity) == infinity);
    CHECK(exp2_poly(-127) == 0);
    CHECK(exp2_poly(-infinity) == 0);
    CHECK(is_nan(exp2_poly(not_a_number)));

    const auto exact = [](double x) { return std::log2(x); };
    CHECK(largest_error(1.1755e-38f, 3.4e38f, log2_poly, exact).ulps <= 1.8);
    CHECK(largest_error(0.5f, 2, log2_poly, exact).ulps <= 1.8);
    CHECK(largest_error(0.99f, 1.01f, log2_poly, exact).ulps <= 1.8);
    CHECK(log2_poly(1) == 0);
    CHECK(log2_poly(8) == 3);
    CHECK(log2_poly(0) == -infinity);
    CHECK(log2_poly(-0.0f) == -infinity);
    CHECK(log2_poly(infinity) == infinity);
    CHECK(is_nan(log2_poly(-1)));
    CHECK(is_nan(log2_poly(not_a_number)));
}

TEST_CASE("pow_poly's error grows with the exponent as stated") {
    for (const float e : {2.4f, 1 / 2.4f, 5.0f, -0.5f, 40.0f}) {
        double worst = 0;
        for (int i = 1; i < 200000; i++) {
            const float base = float(i) / 100000.0f;
            const double truth = std::pow(double(base), double(e));
            if (truth > 1e-37 && truth < 1e38) {
                const double bound = (2 + 1.5 * std::abs(e * std::log2(double(base)))) * 0x1p-23;
                worst = std::max(worst, std::abs(double(pow_poly(base, e)) - truth) / truth / bound);
            }
        }
        CHECK(worst <= 1);
    }
    CHECK(pow_poly(0, 0) == 1);
    CHECK(pow_poly(0, 2) == 0);
    CHECK(pow_poly(0, -2) == infinity);
    CHECK(pow_poly(1, 1e30f) == 1);
}

TEST_CASE("log1p_poly keeps its bound, tiny arguments too") {
    const auto exact = [](double x) { return std::log1p(x); };
    CHECK(largest_error(-0.9999999f, 1e30f, log1p_poly, exact).ulps <= 3.5);
    CHECK(largest_error(-0.999f, 2, log1p_poly, exact).ulps <= 3.5);
    CHECK(largest_error(-1e-3f, 1e-3f, log1p_poly, exact).ulps <= 3.5);
    CHECK(log1p_poly(-1) == -infinity);
    CHECK(is_nan(log1p_poly(-2)));
}

TEST_CASE("Small helpers") {
    CHECK(safe_sqrt(-1e-7f) == 0);
    CHECK(safe_sqrt(4) == 2);
    CHECK(close(luminance(vec3(1, 1, 1)), 1, 1e-6));
    CHECK(luminance(vec3(1, 0, 0)) == 0.2126f);
    CHECK(luminance(vec3(0, 1, 0)) == 0.7152f);
    CHECK(luminance(vec3(0, 0, 1)) == 0.0722f);
    CHECK(max_component(vec3(1, 3, 2)) == 3);
    CHECK(max_component(vec3(3, 1, 2)) == 3);
    CHECK(max_component(vec3(1, 2, 3)) == 3);
}
