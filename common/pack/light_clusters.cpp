#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>
#include <tuple>

#include "pack/alias_table_build.h"
#include "pack/pack_parts.h"

namespace diptych::core {
namespace {

/// Of the extent of all lights: nearer than this to a light, it no longer matters how near.
constexpr double least_distance = 1e-5;

/// Where lights are on average, and the mean square of their distance from there.
struct Place {
    glm::dvec3 center{0};
    double spread = 0;
};

bool has_place(const PackedScene& packed, std::size_t id) {
    const std::size_t emitters = packed.emissive_triangles.size();
    return id < emitters || packed.punctual_lights[id - emitters].type != shared::PUNCTUAL_DIRECTIONAL;
}

Place place_of(const PackedScene& packed, std::size_t id) {
    if (id >= packed.emissive_triangles.size()) {
        return {packed.punctual_lights[id - packed.emissive_triangles.size()].position, 0};
    }
    const shared::EmissiveTriangle& light = packed.emissive_triangles[id];
    const glm::dvec3 a(light.edge_1);
    const glm::dvec3 b(light.edge_2);
    const glm::dvec3 c = b - a;
    return {glm::dvec3(light.vertex_0) + (a + b) / 3.0, (glm::dot(a, a) + glm::dot(b, b) + glm::dot(c, c)) / 36};
}

double pmf_of(const PackedScene& packed, std::size_t id) {
    const std::size_t emitters = packed.emissive_triangles.size();
    return static_cast<double>(id < emitters ? packed.emissive_triangles[id].pmf
                                             : packed.punctual_lights[id - emitters].pmf);
}

/// Lights to be kept together or split: about their mean, across the axis along which they are spread most. Half of a
/// light's weight is its probability and half is that of any light, for dim lamps and those that are off have a place
/// too.
struct Group {
    std::vector<std::uint32_t> lights;
    glm::dvec3 center{0};
    double width = 0;  // variance, over all axes
    int axis = 0;

    bool operator<(const Group& other) const { return width < other.width; }
};

Group make_group(const PackedScene& packed, std::vector<std::uint32_t> lights) {
    Group group;
    group.lights = std::move(lights);
    const double any = 1 / static_cast<double>(packed.emissive_triangles.size() + packed.punctual_lights.size());
    double total = 0;
    glm::dvec3 variance(0);
    for (const std::uint32_t id : group.lights) {
        const double weight = pmf_of(packed, id) + any;
        const glm::dvec3 center = place_of(packed, id).center;
        const glm::dvec3 step = center - group.center;
        total += weight;
        group.center += step * (weight / total);
        variance += weight * step * (center - group.center);
    }
    variance /= total;
    group.width = variance.x + variance.y + variance.z;
    group.axis = variance.y > variance.x ? 1 : 0;
    group.axis = variance.z > variance[group.axis] ? 2 : group.axis;
    return group;
}

/// So many groups at most: whichever is widest is split next.
std::vector<Group> split_lights(const PackedScene& packed, std::vector<std::uint32_t> lights, std::size_t most) {
    std::priority_queue<Group> groups;
    groups.push(make_group(packed, std::move(lights)));
    while (groups.size() < most && groups.top().width > 0) {
        Group whole = groups.top();
        groups.pop();
        std::vector<std::uint32_t> low;
        std::vector<std::uint32_t> high;
        for (const std::uint32_t id : whole.lights) {
            const bool below = place_of(packed, id).center[whole.axis] < whole.center[whole.axis];
            (below ? low : high).push_back(id);
        }
        if (low.empty() || high.empty()) {  // in one place, but for rounding
            whole.width = 0;
            groups.push(whole);
            continue;
        }
        groups.push(make_group(packed, std::move(low)));
        groups.push(make_group(packed, std::move(high)));
    }
    std::vector<Group> split;
    for (; !groups.empty(); groups.pop()) {
        split.push_back(groups.top());
    }
    return split;
}

/// Sums over lights: moments about a mean that moves along (West 1979).
struct Sum {
    double pmf = 0;
    glm::dvec3 center{0};
    double moment = 0;

    void add(const Place& place, double weight) {
        if (weight > 0) {
            pmf += weight;
            const glm::dvec3 step = place.center - center;
            center += step * (weight / pmf);
            moment += weight * (glm::dot(step, place.center - center) + place.spread);
        }
    }
};

/// The farthest from there of the lights that shine, by their centres and their own root mean square.
double radius_of(const PackedScene& packed, const Sum& sum, const std::vector<std::uint32_t>& lights) {
    double radius = 0;
    for (const std::uint32_t id : lights) {
        if (pmf_of(packed, id) > 0) {
            const Place place = place_of(packed, id);
            radius = std::max(radius, glm::length(place.center - sum.center) + std::sqrt(place.spread));
        }
    }
    return radius;
}

shared::LightCluster make_cluster(const Sum& sum, double radius, double least_spread) {
    shared::LightCluster cluster{};
    cluster.center = sum.center;
    cluster.spread = static_cast<float>(std::max(sum.pmf > 0 ? sum.moment / sum.pmf : 0, least_spread));
    cluster.radius = static_cast<float>(std::max(radius, std::sqrt(least_spread)));
    cluster.pmf = static_cast<float>(sum.pmf);
    return cluster;
}

/// The least spread: nearer to a light than that, it no longer matters how near.
double least_spread(const PackedScene& packed) {
    glm::dvec3 lo(1e300);
    glm::dvec3 hi(-1e300);
    for (std::size_t id = 0; id < packed.part_of_light.size(); ++id) {
        if (has_place(packed, id)) {
            lo = glm::min(lo, place_of(packed, id).center);
            hi = glm::max(hi, place_of(packed, id).center);
        }
    }
    const glm::dvec3 extent = least_distance * (hi - lo);
    return glm::dot(extent, extent);
}

/// A part's lights by an alias table of their own.
void append_picks(PackedScene& packed, const std::vector<std::uint32_t>& lights, shared::LightCluster& part) {
    part.first = static_cast<std::uint32_t>(packed.cluster_picks.size());
    part.count = static_cast<std::uint32_t>(lights.size());
    std::vector<double> pmf;
    for (const std::uint32_t id : lights) {
        pmf.push_back(pmf_of(packed, id));
    }
    const double total = std::accumulate(pmf.begin(), pmf.end(), 0.0);
    for (double& p : pmf) {
        p = total > 0 ? p / total : 1 / static_cast<double>(pmf.size());
    }
    const std::vector<shared::AliasEntry> table = build_alias_table(pmf);
    for (std::size_t i = 0; i < table.size(); ++i) {
        packed.cluster_picks.push_back({table[i].probability, lights[i], lights[table[i].alias]});
    }
}

void name_parts(PackedScene& packed) {
    const auto part_of = [&](std::size_t id) {
        return packed.part_of_light.empty() ? shared::NONE : packed.part_of_light[id];
    };
    const std::size_t emitters = packed.emissive_triangles.size();
    for (std::size_t i = 0; i < emitters; ++i) {
        std::uint32_t& flags = packed.emissive_triangles[i].flags;
        flags = (flags & ((1U << shared::EMITTER_PART_SHIFT) - 1)) | (part_of(i) + 1) << shared::EMITTER_PART_SHIFT;
    }
    for (std::size_t i = 0; i < packed.punctual_lights.size(); ++i) {
        packed.punctual_lights[i].part = part_of(emitters + i);
    }
}

}  // namespace

void cluster_lights(PackedScene& packed) {
    const std::size_t count = packed.emissive_triangles.size() + packed.punctual_lights.size();
    std::vector<std::uint32_t> placed;
    for (std::uint32_t id = 0; id < count; ++id) {
        if (has_place(packed, id)) {
            placed.push_back(id);
        }
    }
    const std::vector<Group> clusters = split_lights(packed, std::move(placed), shared::MOST_CLUSTERS);
    packed.part_of_light.clear();
    packed.light_clusters.clear();
    packed.constants.light_cluster_count = 0;
    if (clusters.size() < 2) {
        return;
    }
    packed.part_of_light.assign(count, shared::NONE);
    for (std::size_t k = 0; k < clusters.size(); ++k) {
        const std::vector<Group> parts = split_lights(packed, clusters[k].lights, shared::PARTS_PER_CLUSTER);
        for (std::size_t j = 0; j < parts.size(); ++j) {
            for (const std::uint32_t id : parts[j].lights) {
                packed.part_of_light[id] = static_cast<std::uint32_t>(k * shared::PARTS_PER_CLUSTER + j);
            }
        }
    }
    const std::size_t groups = (clusters.size() + shared::CLUSTERS_PER_GROUP - 1) / shared::CLUSTERS_PER_GROUP;
    packed.constants.light_cluster_count = static_cast<std::uint32_t>(groups * shared::CLUSTERS_PER_GROUP);
}

void weigh_clusters(PackedScene& packed) {
    name_parts(packed);
    const std::size_t clusters = packed.constants.light_cluster_count;
    packed.cluster_picks.clear();
    packed.light_clusters.assign(clusters, {});
    std::vector<std::vector<std::uint32_t>> lights(clusters * shared::PARTS_PER_CLUSTER);
    for (std::uint32_t id = 0; id < packed.part_of_light.size(); ++id) {
        if (packed.part_of_light[id] != shared::NONE) {
            lights[packed.part_of_light[id]].push_back(id);
        }
    }
    const double least = least_spread(packed);
    for (std::size_t k = 0; k < clusters; ++k) {
        Sum whole;
        std::vector<std::uint32_t> all;
        std::uint32_t parts = 0;
        for (std::size_t j = 0; j < shared::PARTS_PER_CLUSTER; ++j) {
            Sum sum;
            const std::vector<std::uint32_t>& own = lights[k * shared::PARTS_PER_CLUSTER + j];
            for (const std::uint32_t id : own) {
                sum.add(place_of(packed, id), pmf_of(packed, id));
                whole.add(place_of(packed, id), pmf_of(packed, id));
            }
            shared::LightCluster part = make_cluster(sum, radius_of(packed, sum, own), least);
            append_picks(packed, own, part);
            packed.light_clusters.push_back(part);
            all.insert(all.end(), own.begin(), own.end());
            parts += own.empty() ? 0 : 1;
        }
        if (all.empty()) {  // fills up a group: the cluster before it, without its lights
            packed.light_clusters[k] = packed.light_clusters[k - 1];
            packed.light_clusters[k].pmf = 0;
        } else {
            packed.light_clusters[k] = make_cluster(whole, radius_of(packed, whole, all), least);
        }
        packed.light_clusters[k].count = parts;
    }
}

}  // namespace diptych::core
