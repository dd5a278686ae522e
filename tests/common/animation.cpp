// Keyframes between their keys: the specification's formulas, evaluated here again in another form.
#include "scene/animation.h"

#include <cmath>

#include "catch.h"

using namespace diptych::core;

namespace {

constexpr double tiny = 1e-6;

double distance(const glm::dvec4& a, const glm::dvec4& b) {
    return glm::length(a - b);
}

/// A turn by `angle` about the unit axis (0, 0.6, 0.8).
glm::vec4 turn(double angle) {
    return glm::vec4(glm::dvec4(0, 0.6 * std::sin(angle / 2), 0.8 * std::sin(angle / 2), std::cos(angle / 2)));
}

Channel of(AnimatedProperty property, Interpolation interpolation, std::vector<float> times,
           std::vector<float> values) {
    return {property, 0, interpolation, std::move(times), std::move(values)};
}

std::vector<float> numbers(std::initializer_list<glm::vec4> values) {
    std::vector<float> out;
    for (const glm::vec4& v : values) {
        out.insert(out.end(), {v.x, v.y, v.z, v.w});
    }
    return out;
}

}  // namespace

TEST_CASE("steps hold, lines run straight, and both stop at the ends", "[animation]") {
    const Channel step = of(AnimatedProperty::translation, Interpolation::step, {1, 2, 4}, {1, 2, 3, 4, 5, 6, 7, 8, 9});
    CHECK(sample_channel(step, -5) == glm::dvec4(1, 2, 3, 0));
    CHECK(sample_channel(step, 1.999) == glm::dvec4(1, 2, 3, 0));
    CHECK(sample_channel(step, 2) == glm::dvec4(4, 5, 6, 0));
    CHECK(sample_channel(step, 3.999) == glm::dvec4(4, 5, 6, 0));
    CHECK(sample_channel(step, 4) == glm::dvec4(7, 8, 9, 0));
    CHECK(sample_channel(step, 1e9) == glm::dvec4(7, 8, 9, 0));
    Channel line = step;
    line.interpolation = Interpolation::linear;
    CHECK(sample_channel(line, 0) == glm::dvec4(1, 2, 3, 0));
    CHECK(distance(sample_channel(line, 1.25), {1.75, 2.75, 3.75, 0}) < 1e-14);
    CHECK(distance(sample_channel(line, 3), {5.5, 6.5, 7.5, 0}) < 1e-14);
    CHECK(sample_channel(line, 77) == glm::dvec4(7, 8, 9, 0));
    CHECK(duration(Animation{"", {step, of(AnimatedProperty::scale, Interpolation::step, {0, 9}, {})}}) == 9);
}

TEST_CASE("a single key holds for ever", "[animation]") {
    const Channel one = of(AnimatedProperty::emissive_strength, Interpolation::linear, {3}, {5});
    const Channel spline = of(AnimatedProperty::emissive_strength, Interpolation::cubic_spline, {3}, {7, 5, 9});
    for (const double seconds : {0.0, 3.0, 8.0}) {
        CHECK(sample_channel(one, seconds).x == 5);
        CHECK(sample_channel(spline, seconds).x == 5);
    }
}

TEST_CASE("rotations turn at a constant rate, the short way, and are unit", "[animation]") {
    for (const double angle : {1e-9, 1e-4, 0.5, 2.0, 3.0}) {
        for (const float sign : {1.0F, -1.0F}) {
            INFO(angle << " " << sign);
            const Channel channel = of(AnimatedProperty::rotation, Interpolation::linear, {0, 2},
                                       numbers({turn(0.25), sign * turn(0.25 + angle)}));
            for (const double seconds : {0.0, 0.3, 1.0, 1.7, 2.0}) {
                const glm::dvec4 q = sample_channel(channel, seconds);
                CHECK(std::abs(glm::length(q) - 1) < 1e-14);
                const glm::dvec4 expected(turn(0.25 + angle * seconds / 2));
                // q and -q are the same rotation; past half a turn the short way is the other one.
                CHECK(std::min(distance(q, expected), distance(q, -expected)) < tiny);
            }
        }
    }
    // 350 degrees apart: 10 degrees the other way.
    const double far = 350 * 3.14159265358979 / 180;
    const Channel around = of(AnimatedProperty::rotation, Interpolation::linear, {0, 1}, numbers({turn(0), turn(far)}));
    const glm::dvec4 half = sample_channel(around, 0.5);
    const glm::dvec4 back(turn((far - 2 * 3.14159265358979) / 2));
    CHECK(std::min(distance(half, back), distance(half, -back)) < tiny);
    // Keys that are not unit count by their direction.
    const Channel loose =
        of(AnimatedProperty::rotation, Interpolation::step, {0, 1}, numbers({3.0F * turn(0.5), turn(1)}));
    CHECK(distance(sample_channel(loose, 0.5), glm::dvec4(turn(0.5))) < tiny);
}

TEST_CASE("a cubic spline through samples of a cubic is that cubic", "[animation]") {
    // p(x) = 2 - x + 0.5 x^2 + 0.25 x^3 has the tangents p'; Hermite interpolation of a cubic is exact.
    const auto p = [](double x) { return 2 - x + 0.5 * x * x + 0.25 * x * x * x; };
    const auto slope = [](double x) { return -1 + x + 0.75 * x * x; };
    const std::vector<float> times{0.5F, 1, 3, 3.25F};
    std::vector<float> values;
    for (const float time : times) {
        const double x = static_cast<double>(time);
        values.insert(values.end(),
                      {static_cast<float>(slope(x)), static_cast<float>(p(x)), static_cast<float>(slope(x))});
    }
    const Channel channel = of(AnimatedProperty::light_intensity, Interpolation::cubic_spline, times, values);
    for (double x = 0.5; x <= 3.25; x += 0.03125) {
        INFO(x);
        CHECK(std::abs(sample_channel(channel, x).x - p(x)) < 1e-5);
    }
}

TEST_CASE("in- and out-tangents of a cubic spline are told apart, and scaled by the keys' distance", "[animation]") {
    // Key: in-tangent, value, out-tangent. Formula of glTF 2.0, appendix C.5, in powers of t.
    const Channel channel =
        of(AnimatedProperty::emissive_strength, Interpolation::cubic_spline, {1, 5}, {100, 2, 0.5F, -0.25F, 3, 100});
    for (const double seconds : {1.0, 1.5, 3.0, 4.75}) {
        const double t = (seconds - 1) / 4;
        const double from = 2 + t * t * (2 * t - 3) * 2 + 3 * t * t * (3 - 2 * t);
        const double tangents = 4 * 0.5 * t * (1 - t) * (1 - t) + 4 * -0.25 * t * t * (t - 1);
        CHECK(std::abs(sample_channel(channel, seconds).x - (from + tangents)) < 1e-12);
    }
    CHECK(sample_channel(channel, 5).x == 3);
    Channel turns = of(AnimatedProperty::rotation, Interpolation::cubic_spline, {0, 1}, {});
    turns.values = numbers({{}, turn(0), {0, 0, 0, 0}, {0, 0, 0, 0}, turn(2), {}});
    const glm::dvec4 middle = sample_channel(turns, 0.5);
    CHECK(std::abs(glm::length(middle) - 1) < 1e-14);
    CHECK(distance(middle, glm::dvec4(turn(1))) < tiny);
}

TEST_CASE("a node's matrix is translation times rotation times scale", "[animation]") {
    Node node;
    node.translation = {1, 2, 3};
    node.rotation = {0, 0, std::sqrt(0.5), std::sqrt(0.5)};  // a quarter turn, x to y
    node.scale = {2, 3, 4};
    const glm::dvec4 moved = node_matrix(node) * glm::dvec4(1, 1, 1, 1);
    CHECK(distance(moved, {1 - 3, 2 + 2, 3 + 4, 1}) < 1e-14);
    node.matrix = glm::dmat4(5);
    CHECK(node_matrix(node) == glm::dmat4(5));
}
