// Clusters of lights against the lights: who belongs where, and what a cluster and a part of one are worth.
#include <cmath>
#include <map>
#include <set>

#include "pack_fixture.h"
#include "generate/generate.h"
#include "pose/pose.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

RenderSettings restir_settings() {
    RenderSettings s = brdf_settings();
    s.integrator = Integrator::restir;
    return s;
}

/// A street of lamps, a point light above it, and the sun.
Scene street() {
    GenerateOptions options;
    options.count = 300;
    Scene scene = generate_scene("many-lights", options).scene;
    PunctualLight point;
    point.light_to_world[3] = {1, 2, 3, 1};
    point.intensity = glm::vec3(5);
    PunctualLight sun;
    sun.type = PunctualType::directional;
    sun.intensity = glm::vec3(1);
    scene.lights = {point, sun};
    return scene;
}

struct Light {
    glm::dvec3 center;
    double spread;
    double pmf;
    std::uint32_t part;
};

Light light_of(const PackedScene& packed, std::size_t id) {
    const std::size_t emitters = packed.emissive_triangles.size();
    if (id >= emitters) {
        const shared::PunctualLight& light = packed.punctual_lights[id - emitters];
        return {light.position, 0, static_cast<double>(light.pmf), light.part};
    }
    const shared::EmissiveTriangle& light = packed.emissive_triangles[id];
    const glm::dvec3 a(light.vertex_0);
    const glm::dvec3 b = a + glm::dvec3(light.edge_1);
    const glm::dvec3 c = a + glm::dvec3(light.edge_2);
    const glm::dvec3 center = (a + b + c) / 3.0;
    double corners = 0;
    for (const glm::dvec3& corner : {a, b, c}) {
        corners += glm::dot(corner - center, corner - center);
    }
    // A triangle's second moment is that of its corners over 12, of unit mass.
    return {center, corners / 12, static_cast<double>(light.pmf), (light.flags >> shared::EMITTER_PART_SHIFT) - 1};
}

/// What a cluster or a part of one has to be, from its lights.
void check_moments(const shared::LightCluster& cluster, const std::vector<Light>& lights) {
    double pmf = 0;
    glm::dvec3 center(0);
    for (const Light& light : lights) {
        pmf += light.pmf;
        center += light.pmf * light.center;
    }
    REQUIRE(pmf > 0);
    center /= pmf;
    double spread = 0;
    for (const Light& light : lights) {
        const glm::dvec3 off = light.center - center;
        spread += light.pmf / pmf * (glm::dot(off, off) + light.spread);
    }
    CHECK(static_cast<double>(cluster.pmf) == Approx(pmf).epsilon(1e-6));
    CHECK(glm::length(glm::dvec3(cluster.center) - center) < 1e-5 * (1 + glm::length(center)));
    CHECK(static_cast<double>(cluster.spread) == Approx(spread).epsilon(1e-4).margin(1e-5));
    double radius = 0;
    for (const Light& light : lights) {
        const double own = glm::length(light.center - center) + std::sqrt(light.spread);
        radius = light.pmf > 0 ? std::max(radius, own) : radius;
    }
    const double least = 0.01;  // points have one too, a 10^-5 of the street's length
    CHECK(static_cast<double>(cluster.radius) == Approx(radius).epsilon(1e-4).margin(radius < least ? least : 1e-4));
    CHECK(cluster.radius > 0);
}

}  // namespace

TEST_CASE("each light with a place is in one part of one cluster, which knows what they are worth and where") {
    const PackedScene packed = pack_scene(street(), restir_settings());
    const std::size_t clusters = packed.constants.light_cluster_count;
    REQUIRE(clusters > 16);
    REQUIRE(packed.light_clusters.size() == clusters * (1 + shared::PARTS_PER_CLUSTER));
    const std::size_t lights = packed.emissive_triangles.size() + 2;
    std::vector<std::vector<Light>> of_cluster(clusters);
    std::vector<std::vector<Light>> of_part(clusters * shared::PARTS_PER_CLUSTER);
    for (std::size_t id = 0; id < lights; ++id) {
        const Light light = light_of(packed, id);
        if (id == lights - 1) {
            CHECK(light.part == shared::NONE);  // the sun is nowhere
            continue;
        }
        REQUIRE(light.part < of_part.size());
        of_part[light.part].push_back(light);
        of_cluster[light.part / shared::PARTS_PER_CLUSTER].push_back(light);
    }
    for (std::size_t k = 0; k < clusters; ++k) {
        check_moments(packed.light_clusters[k], of_cluster[k]);
        for (std::uint32_t j = 0; j < shared::PARTS_PER_CLUSTER; ++j) {
            const bool has_part = j < packed.light_clusters[k].count;
            CHECK(of_part[k * shared::PARTS_PER_CLUSTER + j].empty() != has_part);
        }
    }
    for (std::size_t p = 0; p < of_part.size(); ++p) {
        const shared::LightCluster& part = packed.light_clusters[clusters + p];
        REQUIRE(part.count == of_part[p].size());
        if (part.count > 0) {
            check_moments(part, of_part[p]);
        } else {
            CHECK(part.pmf == 0);
        }
    }
}

TEST_CASE("a part's table picks each of its lights in proportion") {
    const PackedScene packed = pack_scene(street(), restir_settings());
    const std::size_t clusters = packed.constants.light_cluster_count;
    std::set<std::uint32_t> seen;
    for (std::size_t p = clusters; p < packed.light_clusters.size(); ++p) {
        const shared::LightCluster& part = packed.light_clusters[p];
        std::map<std::uint32_t, double> share;
        for (std::uint32_t i = part.first; i < part.first + part.count; ++i) {
            const shared::ClusterPick& pick = packed.cluster_picks.at(i);
            CHECK(seen.insert(pick.light).second);
            share[pick.light] += static_cast<double>(pick.probability) / part.count;
            share[pick.alias] += (1 - static_cast<double>(pick.probability)) / part.count;
        }
        REQUIRE(share.size() == part.count);
        for (const auto& [id, probability] : share) {
            CHECK(light_of(packed, id).part == p - clusters);
            CHECK(probability == Approx(light_of(packed, id).pmf / static_cast<double>(part.pmf)).epsilon(1e-5));
        }
    }
    CHECK(seen.size() == packed.emissive_triangles.size() + 1);
}

TEST_CASE("the last group is filled up with clusters of no light, where the last cluster is") {
    const Scene scene = generate_scene("cornell").scene;  // a lamp of two triangles
    const PackedScene packed = pack_scene(scene, restir_settings());
    const std::size_t clusters = packed.constants.light_cluster_count;
    CHECK(clusters % shared::CLUSTERS_PER_GROUP == 0);
    std::size_t filled = 0;
    for (std::size_t k = 1; k < clusters; ++k) {
        const shared::LightCluster& cluster = packed.light_clusters[k];
        if (cluster.count == 0) {
            filled += 1;
            CHECK(cluster.pmf == 0);
            CHECK(cluster.center == packed.light_clusters[k - 1].center);
            CHECK(cluster.radius == packed.light_clusters[k - 1].radius);
            for (std::size_t j = 0; j < shared::PARTS_PER_CLUSTER; ++j) {
                CHECK(packed.light_clusters[clusters + k * shared::PARTS_PER_CLUSTER + j].pmf == 0);
            }
        }
    }
    CHECK(filled == clusters - 2);
}

TEST_CASE("clusters are left out where nothing resamples, or all light is in one place") {
    RenderSettings settings = restir_settings();
    settings.integrator = Integrator::path;
    CHECK(pack_scene(street(), settings).light_clusters.empty());
    Scene scene = least_scene();
    scene.lights.emplace_back();
    const PackedScene packed = pack_scene(scene, restir_settings());
    CHECK(packed.light_clusters.empty());
    CHECK(packed.constants.light_cluster_count == 0);
    CHECK(packed.punctual_lights[0].part == shared::NONE);
}

TEST_CASE("clusters go with their lights, of which none changes its part") {
    Scene scene = generate_scene("moving-light").scene;
    RenderSettings settings = restir_settings();
    settings.moves = true;
    PackedScene packed = pack_scene(scene, settings);
    const std::size_t clusters = packed.constants.light_cluster_count;
    REQUIRE(clusters >= 2);
    const std::size_t lights = packed.emissive_triangles.size() + packed.punctual_lights.size();
    std::vector<std::uint32_t> parts;
    for (std::size_t id = 0; id < lights; ++id) {
        parts.push_back(light_of(packed, id).part);
    }
    for (const double seconds : {0.5, 1.5, 3.0}) {
        INFO(seconds);
        pose_scene(scene, seconds);
        pack_moment(scene, settings, packed);
        REQUIRE(packed.constants.light_cluster_count == clusters);
        std::vector<std::vector<Light>> of_cluster(clusters);
        for (std::size_t id = 0; id < lights; ++id) {
            const Light light = light_of(packed, id);
            CHECK(light.part == parts[id]);
            of_cluster[light.part / shared::PARTS_PER_CLUSTER].push_back(light);
        }
        for (std::size_t k = 0; k < clusters; ++k) {
            if (packed.light_clusters[k].pmf > 0) {
                check_moments(packed.light_clusters[k], of_cluster[k]);
            }
        }
    }
}
