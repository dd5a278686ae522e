// What the light tree holds a light to be worth, and its search through a node, against what they have to be.
#include "catch.h"

#include <cmath>
#include <numbers>

#include "lights/light_tree.h"

using namespace diptych::core::shared;

namespace {

/// Child 0 alone emits: a small lamp of unit power at `center`, whose normals are about `axis`.
LightNode lamp(const vec3& center, const vec3& axis, float front, float spread) {
    LightNode node{};
    for (uint i = 0; i < LIGHT_NODE_WIDTH; i++) {
        node.spread[i] = 1;
        node.blur[i] = 1;
    }
    node.center_x[0] = center.x;
    node.center_y[0] = center.y;
    node.center_z[0] = center.z;
    node.place[0] = 1;
    node.spread[0] = spread;
    node.axis_x[0] = axis.x;
    node.axis_y[0] = axis.y;
    node.axis_z[0] = axis.z;
    node.blur[0] = 1e-4F;
    node.front[0] = front;
    node.power[0] = 1;
    return node;
}

double weight(const LightNode& node, const vec3& position, const vec3& normal) {
    return static_cast<double>(light_weight(node, 0, position, normal));
}

LightNode node_of(const float (&powers)[8]) {
    LightNode node = lamp({0, 0, 0}, {0, 0, 0}, 0, 1);
    for (uint i = 0; i < LIGHT_NODE_WIDTH; i++) {
        node.place[i] = 1;
        node.blur[i] = 1;
        node.power[i] = powers[i];
        node.child[i] = 100 + i;
    }
    return node;
}

}  // namespace

TEST_CASE("A small lamp far away is worth its irradiance") {
    const vec3 center(3, 4, -12);
    for (const float tilt : {0.0F, 0.5F, 1.0F}) {
        const vec3 axis = normalize(vec3(-3, -4, 12) + tilt * vec3(4, -3, 2));
        const vec3 normal = normalize(vec3(3, 4, -12) + tilt * vec3(1, 9, 1));
        const vec3 to = center / length(center);
        const auto expected = static_cast<double>(dot(to, normal) * -dot(to, axis) / dot(center, center));
        REQUIRE(expected > 0);
        CHECK(weight(lamp(center, axis, 1, 1e-6F), vec3(0), normal) == Approx(4 * expected).epsilon(0.01));
        // A two-sided lamp is worth the same from both sides, a one-sided one next to nothing from behind.
        CHECK(weight(lamp(center, axis, 0, 1e-6F), vec3(0), normal) == Approx(4 * expected).epsilon(0.01));
        CHECK(weight(lamp(center, -axis, 0, 1e-6F), vec3(0), normal) == Approx(4 * expected).epsilon(0.01));
        const double behind = weight(lamp(center, -axis, 1, 1e-6F), vec3(0), normal);
        CHECK(behind > 0);
        CHECK(behind < 0.01 * expected);
    }
}

TEST_CASE("Lights whose mean is at the horizon, or behind, are worth the more the wider they lie") {
    const vec3 along(5, 0, 0);
    const vec3 below(5, -3, 0);
    for (const vec3& center : {along, below}) {
        const double narrow = weight(lamp(center, {-1, 0, 0}, 1, 1e-4F), vec3(0), {0, 1, 0});
        const double wide = weight(lamp(center, {-1, 0, 0}, 1, 4), vec3(0), {0, 1, 0});
        CHECK(narrow > 0);
        CHECK(wide > 2 * narrow);
    }
}

TEST_CASE("A light at infinity is worth the same everywhere") {
    LightNode sun = lamp({0, 1, 0}, {0, 0, 0}, 1, 1e-12F);
    sun.place[0] = 0;
    CHECK(weight(sun, vec3(0), {0, 1, 0}) == weight(sun, {1e6F, -3, 1e6F}, {0, 1, 0}));
    CHECK(weight(sun, vec3(0), {0, 1, 0}) > 100 * weight(sun, vec3(0), {0, -1, 0}));
}

TEST_CASE("A node's search finds each child in proportion, never one of weight 0, and spreads what follows evenly") {
    const float all[][8] = {{1, 2, 3, 4, 5, 6, 7, 8},
                            {0, 1, 0, 0, 3, 0, 0, 0},
                            {1, 0, 0, 0, 0, 0, 0, 0},
                            {0, 0, 0, 0, 0, 0, 0, 1},
                            {0, 0, 1e-3F, 1, 0, 1e-3F, 1e-3F, 0}};
    for (const auto& powers : all) {
        const LightNode node = node_of(powers);
        const LightWeights weights = light_weights(node, vec3(1, 2, 3), vec3(0, 1, 0));
        constexpr uint steps = 1U << 16U;
        double count[8] = {};
        double rest[8] = {};
        for (uint k = 0; k < steps; k++) {
            SharedNumber n = share_number(uvec2(k << 16U, k * 2654435761U));
            const PickedChild picked = pick_child(node, weights, n);
            const uint i = picked.link - 100;
            REQUIRE(i < 8);
            REQUIRE(powers[i] > 0);
            REQUIRE(picked.probability == child_probability(weights, i));
            REQUIRE((n.u >= 0 && n.u < 1));
            count[i] += 1.0 / steps;
            rest[i] += static_cast<double>(n.u) / steps;
        }
        for (uint i = 0; i < 8; i++) {
            const auto p = static_cast<double>(child_probability(weights, i));
            CHECK(count[i] == Approx(p).margin(2.0 / steps));
            if (p > 1e-3) {
                CHECK(rest[i] / count[i] == Approx(0.5).margin(0.02));
            }
        }
    }
}

TEST_CASE("A packed normal is the normal to a thousandth") {
    for (int i = 0; i < 1000; i++) {
        const float a = static_cast<float>(i) * 0.7F;
        const float z = static_cast<float>(i) / 500 - 1;
        const float r = std::sqrt(std::max(0.0F, 1 - z * z));
        const vec3 n(r * std::cos(a), r * std::sin(a), z);
        CHECK(length(unpack_facing(pack_facing(n)) - n) < 2e-3F);
    }
    CHECK(unpack_facing(pack_facing({-1, 0, 1})) == vec3(-1, 0, 1));
}
