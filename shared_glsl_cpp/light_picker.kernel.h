// Picks light points for one place: some by power, as paths do; the others from clusters of lights (light_clusters.h), by power over the
// square of the distance, a cluster close by part by part, so that a lamp close by is found though it is a millionth of the scene's power. Both are weighed by the density of
// all picks together (the balance heuristic, Veach and Guibas 1995).
#ifndef LIGHT_PICKER_KERNEL_H
#define LIGHT_PICKER_KERNEL_H

#include "light_point.kernel.h"

struct LightPicker {
    vec3 position;
    vec3 normal;
    uint by_power;  // picks
    uint near;      // picks
    float sum;      // of the clusters' weights
    bool close;     // emitters may be within reach
};

/// What a cluster is worth to a place.
FN float cluster_weight(IN(LightPicker) p, IN(LightCluster) cluster) {
    PRECISE float weight = cluster.pmf * cluster_falloff(cluster, p.position, p.normal);
    return weight;
}

/// Metres. Points on emitters nearer than this are picked too seldom.
FN float light_reach() { return constants.resampling.reach * inversesqrt(float(constants.resampling.light_candidates)); }

FN LightPicker begin_light_picker(IN(TargetSurface) surface) {
    LightPicker p;
    p.position = surface.position;
    p.normal = surface.normal;
    p.near = constants.resampling.near_candidates;
    p.sum = 0.0f;
    p.close = constants.resampling.reach > 0.0f;
    if (p.near > 0u && constants.light_cluster_count > 0u) {
        p.close = false;
        float reach = light_reach();
        for (uint i = 0u; i < constants.light_cluster_count; i++) {
            LightCluster cluster = load_light_clusters(i);
            p.sum += cluster_weight(p, cluster);
            p.close = p.close || (reach > 0.0f && is_near_cluster(cluster, p.position, reach));
        }
    }
    // So far away that nothing is left of it.
    p.near = p.sum > 0.0f && p.sum < INFINITE_DISTANCE ? p.near : 0u;
    p.by_power = constants.resampling.light_candidates - p.near;
    return p;
}

FN LightCluster load_cluster_part(uint part) { return load_light_clusters(constants.light_cluster_count + part); }

/// The sum of the weights of a cluster's parts; 0: there all lights are picked by power.
FN float parts_sum(IN(LightPicker) p, uint cluster, IN(LightCluster) whole) {
    float sum = 0.0f;
    if (is_near_cluster(whole, p.position, 0.0f)) {
        for (uint i = 0u; i < PARTS_PER_CLUSTER; i++) {
            sum += cluster_weight(p, load_cluster_part(cluster * PARTS_PER_CLUSTER + i));
        }
    }
    return sum < INFINITE_DISTANCE ? sum : 0.0f;
}

/// The density of all picks together where that of one pick by power is 1.
FN float picks_of_light(IN(LightPicker) p, uint id) {
    uint part = NONE;
    if (p.near > 0u && feature(FEATURE_EMISSIVE) && id < constants.emissive_triangle_count) {
        part = part_of_flags(load_emissive_triangles(id).flags);
    } else if (p.near > 0u && feature(FEATURE_PUNCTUAL) &&
               id - constants.emissive_triangle_count < constants.punctual_light_count) {
        part = load_punctual_lights(id - constants.emissive_triangle_count).part;
    }
    if (part == NONE) {
        return float(p.by_power);
    }
    uint cluster = part / PARTS_PER_CLUSTER;
    LightCluster whole = load_light_clusters(cluster);
    float falloff = cluster_falloff(whole, p.position, p.normal);
    float parts = parts_sum(p, cluster, whole);
    if (parts > 0.0f) {
        falloff *= whole.pmf / parts * cluster_falloff(load_cluster_part(part), p.position, p.normal);
    }
    float near = float(p.near) * falloff / p.sum;
    return float(p.by_power) + MUTANT(NEAR_PICKS_UNWEIGHED, near, float(p.near));
}

/// Picks from clusters go through them in one sweep, as they are at equal steps of the sum.
struct ClusterSweep {
    float offset;   // of the steps, [0, 1)
    float reached;  // the sum before `cluster`
    uint cluster;
    LightCluster current;
    float weight;
};

FN ClusterSweep begin_cluster_sweep(IN(LightPicker) p, IN(Sampler) random) {
    ClusterSweep s;
    s.offset = unit_float(independent_words(random, DIMENSION_CLUSTER).x);
    s.reached = 0.0f;
    s.cluster = 0u;
    s.weight = 0.0f;
    if (p.near > 0u) {
        s.current = load_light_clusters(0u);
        s.weight = cluster_weight(p, s.current);
    }
    return s;
}

/// A part of a cluster: where that is near by its own weight, else by power.
FN LightCluster pick_part(IN(LightPicker) p, uint cluster, IN(LightCluster) whole, float u) {
    float sum = parts_sum(p, cluster, whole);
    float end = u * (sum > 0.0f ? sum : whole.pmf);
    LightCluster part = load_cluster_part(cluster * PARTS_PER_CLUSTER);
    float reached = 0.0f;
    for (uint i = 0u; i < PARTS_PER_CLUSTER; i++) {
        LightCluster next = load_cluster_part(cluster * PARTS_PER_CLUSTER + i);
        float weight = sum > 0.0f ? cluster_weight(p, next) : next.pmf;
        if (weight > 0.0f && reached <= end) {
            part = next;
        }
        reached += weight;
    }
    return part;
}

/// The light of the near pick `step`; steps rise. `words` are three.
FN uint pick_near_light(INOUT(ClusterSweep) s, IN(LightPicker) p, uint step, uvec3 words) {
    float end = (float(step) + s.offset) / float(p.near) * p.sum;
    while (s.reached + s.weight <= end && s.cluster + 1u < constants.light_cluster_count) {
        s.reached += s.weight;
        s.cluster += 1u;
        s.current = load_light_clusters(s.cluster);
        s.weight = cluster_weight(p, s.current);
    }
    LightCluster part = pick_part(p, s.cluster, s.current, unit_float(words.z));
    ClusterPick column = load_cluster_picks(part.first + alias_column(words.x, part.count));
    AliasEntry entry;
    entry.probability = column.probability;
    entry.alias = column.alias;
    return alias_pick(entry, column.light, words.y);
}

#endif
