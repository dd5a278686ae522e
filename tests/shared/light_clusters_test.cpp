// Clusters of lights: what their distance makes them worth.
#include "lights/light_clusters.h"

#include <algorithm>
#include <cmath>

#include "catch.h"
#include "close.h"

using namespace diptych::core::shared;
using diptych::core::tests::close;

namespace {

LightCluster cluster() {
    LightCluster c;
    c.center = vec3(1.0f, 2.0f, 4.0f);
    c.spread = 0.75f;
    c.pmf = 0.5f;
    c.first = 0u;
    c.count = 3u;
    c.radius = 1.25f;
    return c;
}

}  // namespace

TEST_CASE("A cluster's falloff is the cosine of its highest light over the mean square of the distance") {
    const LightCluster c = cluster();
    for (const vec3 place : {vec3(0.0f, 0.0f, 0.0f), vec3(1.0f, 2.0f, 3.5f), vec3(7.0f, -3.0f, 4.0f), vec3(1.0f, 2.0f, 9.0f)}) {
        for (const vec3 normal : {vec3(0.0f, 0.0f, 1.0f), vec3(0.6f, 0.0f, -0.8f), vec3(0.0f, 1.0f, 0.0f)}) {
            const glm::dvec3 d = glm::dvec3(c.center) - glm::dvec3(place);
            const double square = glm::dot(d, d) + 0.75;
            const double height = std::max(glm::dot(d, glm::dvec3(normal)) + 1.25, 0.0);
            CAPTURE(place.x, place.y, place.z, height);
            CHECK(close(cluster_falloff(c, place, normal), height / std::pow(square, 1.5), 1e-5));
        }
    }
    CHECK(cluster_falloff(c, vec3(1.0f, 2.0f, 9.0f), vec3(0.0f, 0.0f, 1.0f)) == 0.0f);  // wholly below
    CHECK(cluster_falloff(c, vec3(1.0f, 2.0f, 5.0f), vec3(0.0f, 0.0f, 1.0f)) > 0.0f);   // its highest light is above
}

TEST_CASE("The squared excess is negative within two radii of a cluster's centre") {
    const LightCluster c = cluster();
    CHECK(close(squared_excess(c, vec3(1.0f, 2.0f, 4.0f)), -6.25, 1e-6));
    CHECK(close(squared_excess(c, vec3(4.0f, 6.0f, 16.0f)), 169.0 - 6.25, 1e-6));
    CHECK(std::abs(squared_excess(c, vec3(1.0f, 4.5f, 4.0f))) < 1e-5f);
}

TEST_CASE("A triangle's part of a cluster lies in the high bits of its flags, one up") {
    CHECK(part_of_flags(EMITTER_TWO_SIDED | EMITTER_VARIES) == NONE);
    CHECK(part_of_flags(EMITTER_TWO_SIDED | (1u << EMITTER_PART_SHIFT)) == 0u);
    CHECK(part_of_flags((8u << EMITTER_PART_SHIFT) | EMITTER_VARIES) == 7u);
}
