// The night street keeps its promises: how many emitters, how strong, how hidden.
#include "catch.h"
#include "error.h"
#include "generate_fixture.h"

#include <algorithm>
#include <cmath>

using namespace diptych::core;
using namespace diptych::core::generate_tests;

namespace {

Scene street(std::uint64_t count, std::uint32_t seed = 1) {
    return generate_scene("many-lights", {.count = count, .seed = seed}).scene;
}

std::vector<WorldTriangle> emitters_of(const Scene& scene) {
    std::vector<WorldTriangle> out;
    for (const Instance& instance : scene.instances) {
        for (const WorldTriangle& triangle : world_triangles(scene, instance)) {
            if (triangle.material->emission != glm::vec3(0)) {
                out.push_back(triangle);
            }
        }
    }
    return out;
}

double power(const WorldTriangle& triangle) {
    const glm::dvec3 radiance(triangle.material->emission);
    return 3.14159265358979 * glm::length(triangle.area_vector()) * (radiance.x + radiance.y + radiance.z) / 3;
}

struct Box {
    glm::dvec3 low, high;
};

/// Houses, ledges and signs are instances of one unit box.
std::vector<Box> boxes_of(const Scene& scene) {
    std::vector<Box> out;
    for (const Instance& instance : scene.instances) {
        const auto& primitive = scene.meshes[std::size_t(instance.mesh)].primitives[0];
        if (primitive.triangles.size() != 12 || !instance.name.empty()) {
            continue;
        }
        out.push_back({glm::dvec3(instance.object_to_world * glm::dvec4(0, 0, 0, 1)),
                       glm::dvec3(instance.object_to_world * glm::dvec4(1, 1, 1, 1))});
    }
    return out;
}

bool is_blocked(const glm::dvec3& from, const glm::dvec3& to, const std::vector<Box>& boxes) {
    return std::any_of(boxes.begin(), boxes.end(), [&](const Box& box) {
        double enter = 1e-4, leave = 1 - 1e-4;
        for (int i = 0; i < 3; ++i) {
            const double step = to[i] - from[i];
            if (step == 0) {
                if (from[i] < box.low[i] || from[i] > box.high[i]) {
                    return false;
                }
                continue;
            }
            const double a = (box.low[i] - from[i]) / step, b = (box.high[i] - from[i]) / step;
            enter = std::max(enter, std::min(a, b));
            leave = std::min(leave, std::max(a, b));
        }
        return enter < leave;
    });
}

}  // namespace

TEST_CASE("many-lights has exactly as many emitting triangles as asked for", "[generate]") {
    for (const std::uint64_t count : {1, 2, 10, 999, 1000, 100000}) {
        const Scene scene = street(count);
        const auto emitters = emitters_of(scene);
        CHECK(emitters.size() == count);
        CHECK(scene.instances.size() < 3000);
        CHECK(scene.materials.size() < 100);
        for (const WorldTriangle& triangle : emitters) {
            CHECK(glm::length(triangle.area_vector()) > 0);
        }
    }
    CHECK_THROWS_AS(street(0), Error);
}

TEST_CASE("many-lights spreads power evenly over six decades", "[generate]") {
    const Scene scene = street(20000);
    std::vector<double> exponents;
    for (const WorldTriangle& triangle : emitters_of(scene)) {
        exponents.push_back(std::log10(power(triangle)));
    }
    std::sort(exponents.begin(), exponents.end());
    CHECK(std::abs(exponents.back() - exponents.front() - 6) < 1e-3);
    for (std::size_t i = 0; i < exponents.size(); i += 500) {
        const double uniform = exponents.front() + 6 * double(i) / double(exponents.size());
        CHECK(std::abs(exponents[i] - uniform) < 6.0 / 47);
    }
}

TEST_CASE("many-lights sends out the same power whatever the count", "[generate]") {
    for (const std::uint64_t count : {1000, 30000}) {
        double sum = 0;
        const Scene scene = street(count);
        for (const WorldTriangle& triangle : emitters_of(scene)) {
            sum += power(triangle);
        }
        CHECK(sum > 2.2e4);
        CHECK(sum < 3.8e4);
    }
}

TEST_CASE("many-lights hides most emitters from most points", "[generate]") {
    const Scene scene = street(2000);
    const auto emitters = emitters_of(scene);
    const auto boxes = boxes_of(scene);
    REQUIRE(boxes.size() > 60);
    int seen = 0, pairs = 0, facing_out = 0;
    for (std::size_t i = 0; i < emitters.size(); i += 7) {
        const glm::dvec3 from = emitters[i].center() + 1e-3 * glm::normalize(emitters[i].area_vector());
        const bool inside_box = is_blocked(from, from + 1e-6 * glm::normalize(emitters[i].area_vector()), boxes);
        facing_out += inside_box ? 0 : 1;
        for (std::size_t j = 3; j < emitters.size(); j += 11) {
            const glm::dvec3 to = emitters[j].center();
            const bool fronts = glm::dot(emitters[j].area_vector(), from - to) > 0 &&
                                glm::dot(emitters[i].area_vector(), to - from) > 0;
            seen += fronts && !is_blocked(from, to, boxes) ? 1 : 0;
            ++pairs;
        }
    }
    CHECK(double(seen) < 0.1 * pairs);
    CHECK(seen > 0);
    CHECK(facing_out * 7 > int(emitters.size()) * 98 / 100);
}

TEST_CASE("many-lights differs by seed alone", "[generate]") {
    const auto first = emitters_of(street(100, 1)), again = emitters_of(street(100, 1)),
               other = emitters_of(street(100, 2));
    CHECK(first.at(50).a == again.at(50).a);
    CHECK(first.at(50).a != other.at(50).a);
}
