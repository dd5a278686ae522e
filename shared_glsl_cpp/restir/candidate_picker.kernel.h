// Picks the lights of a reservoir's candidates at one shading point. Some picks are by power, as for paths. The other
// picks are from clusters of lights (light_clusters.h), by power times cosine over squared distance; near a cluster,
// its parts are weighed one by one. So a near lamp is found even if it has a millionth of the scene's power.
// Candidates are weighted by the density of all picks together (balance heuristic, Veach and Guibas 1995).
#ifndef CANDIDATE_PICKER_KERNEL_H
#define CANDIDATE_PICKER_KERNEL_H

#include "lights/light.kernel.h"

struct CandidatePicker {
    vec3 position;
    vec3 normal;
    uint by_power;  // number of picks by power
    uint near;      // number of picks from clusters
    float sum;      // of the weights of all clusters
    float groups[CLUSTER_GROUPS];  // partial sums over CLUSTERS_PER_GROUP clusters; a pick visits one group
    bool close;     // emitters may be within light_reach
};

/// The weight (worth) of a cluster at the shading point: an estimate of its unoccluded light.
FN float cluster_weight(IN(CandidatePicker) p, IN(LightCluster) cluster) {
    PRECISE float weight = cluster.pmf * cluster_falloff(cluster, p.position, p.normal);
    return weight;
}

/// Metres. Picking by power finds points on emitters that are nearer than this too rarely.
FN float light_reach() { return constants.resampling.reach * inversesqrt(float(constants.resampling.light_candidates)); }

FN CandidatePicker begin_candidate_picker(IN(TargetSurface) surface) {
    CandidatePicker p;
    p.position = surface.position;
    p.normal = surface.normal;
    p.near = constants.resampling.near_candidates;
    p.sum = 0.0f;
    p.close = constants.resampling.reach > 0.0f;
    if (p.near > 0u && constants.light_cluster_count > 0u) {
        float reach = light_reach();
        float nearest = INFINITE_DISTANCE;
        for (uint g = 0u; g < CLUSTER_GROUPS; g++) {
            float sum = 0.0f;
            if (g * CLUSTERS_PER_GROUP < constants.light_cluster_count) {
                for (uint i = 0u; i < CLUSTERS_PER_GROUP; i++) {
                    LightCluster cluster = load_light_clusters(g * CLUSTERS_PER_GROUP + i);
                    sum += cluster_weight(p, cluster);
                    nearest = min(nearest, squared_excess(cluster, p.position));
                }
            }
            p.groups[g] = sum;
            p.sum += sum;
        }
        p.close = reach > 0.0f && nearest < reach * reach;
    }
    // An infinite sum of weights cannot be sampled. Then all picks are by power.
    p.sum = p.sum < INFINITE_DISTANCE ? p.sum : 0.0f;
    p.near = p.sum > 0.0f ? p.near : 0u;
    p.by_power = constants.resampling.light_candidates - p.near;
    return p;
}

/// The same picker restored from a request, for densities only: it cannot pick.
FN CandidatePicker resume_candidate_picker(IN(TargetSurface) surface, IN(CandidateRequest) request) {
    CandidatePicker p;
    p.position = surface.position;
    p.normal = surface.normal;
    p.sum = request.near_sum;
    p.close = (request.needs & CANDIDATE_IS_CLOSE) != 0u;
    p.near = p.sum > 0.0f ? constants.resampling.near_candidates : 0u;
    p.by_power = constants.resampling.light_candidates - p.near;
    return p;
}

FN LightCluster load_cluster_part(uint cluster, uint i) {
    return load_light_clusters(constants.light_cluster_count + cluster * PARTS_PER_CLUSTER + i);
}

/// Sum of the weights of a cluster's parts; unused parts have weight 0. The result is 0 where the parts are to be
/// picked by power.
FN float parts_sum(IN(CandidatePicker) p, uint cluster, IN(LightCluster) whole) {
    float sum = 0.0f;
    if (whole.count > 1u && squared_excess(whole, p.position) < 0.0f) {
        for (uint i = 0u; i < PARTS_PER_CLUSTER; i++) {
            sum += cluster_weight(p, load_cluster_part(cluster, i));
        }
    }
    return sum < INFINITE_DISTANCE ? sum : 0.0f;
}

/// Expected number of picks of a light of this part, relative to one pick by power. `weight` is the cluster's weight,
/// `parts` the cluster's parts_sum.
FN float picks_of_part(IN(CandidatePicker) p, IN(LightCluster) whole, float weight, IN(LightCluster) part, float parts) {
    float of_part = parts > 0.0f ? cluster_falloff(part, p.position, p.normal) / parts : 1.0f / whole.pmf;
    float near = float(p.near) * (weight / p.sum) * of_part;
    return float(p.by_power) + MUTANT(NEAR_PICKS_UNWEIGHED, near, float(p.near));
}

/// The same for any light.
FN float picks_of_light(IN(CandidatePicker) p, uint id) {
    uint part = NONE;
    if (p.near > 0u) {
        part = cluster_part_of_light(id);
    }
    if (part == NONE) {
        return float(p.by_power);
    }
    uint cluster = part / PARTS_PER_CLUSTER;
    LightCluster whole = load_light_clusters(cluster);
    float weight = cluster_weight(p, whole);
    if (!(weight > 0.0f)) {
        return float(p.by_power);
    }
    LightCluster own = load_cluster_part(cluster, part % PARTS_PER_CLUSTER);
    return picks_of_part(p, whole, weight, own, parts_sum(p, cluster, whole));
}

/// Stratified picks from clusters: at equal steps through the sum of the clusters' weights.
struct ClusterSteps {
    float offset;        // of all steps, in [0, 1) of a step
    uint cluster;        // of the last step; NONE before the first
    LightCluster whole;  // the cluster of the last step
    float weight;        // its cluster_weight
    float parts;         // its parts_sum
};

FN ClusterSteps begin_cluster_steps(IN(Sampler) random) {
    ClusterSteps s;
    s.offset = unit_float(independent_words(random, DIMENSION_CLUSTER).x);
    s.cluster = NONE;
    s.weight = 0.0f;
    s.parts = 0.0f;
    return s;
}

/// The last cluster of positive weight whose interval of the running sum starts at or before `end`.
FN uint cluster_at(IN(CandidatePicker) p, float end) {
    uint group = 0u;
    float start = 0.0f;
    float reached = 0.0f;
    for (uint g = 0u; g < CLUSTER_GROUPS; g++) {
        if (p.groups[g] > 0.0f && reached <= end) {
            group = g;
            start = reached;
        }
        reached += p.groups[g];
    }
    uint cluster = group * CLUSTERS_PER_GROUP;
    reached = start;
    for (uint i = 0u; i < CLUSTERS_PER_GROUP; i++) {
        uint next = group * CLUSTERS_PER_GROUP + i;
        float weight = cluster_weight(p, load_light_clusters(next));
        cluster = weight > 0.0f && reached <= end ? next : cluster;
        reached += weight;
    }
    return cluster;
}

/// Moves to the cluster at `end`. Steps are in increasing order, so that steps within one cluster are consecutive.
FN void step_to(INOUT(ClusterSteps) s, IN(CandidatePicker) p, float end) {
    uint cluster = cluster_at(p, end);
    if (cluster != s.cluster) {
        s.cluster = cluster;
        s.whole = load_light_clusters(cluster);
        s.weight = cluster_weight(p, s.whole);
        s.parts = parts_sum(p, cluster, s.whole);
    }
}

/// Picks a part of the cluster, by weight, or by power where `parts` is 0.
FN LightCluster pick_part(IN(ClusterSteps) s, IN(CandidatePicker) p, float u) {
    uint chosen = 0u;
    float end = u * (s.parts > 0.0f ? s.parts : s.whole.pmf);
    float reached = 0.0f;
    for (uint i = 0u; i < s.whole.count && reached <= end; i++) {
        LightCluster part = load_cluster_part(s.cluster, i);
        float weight = s.parts > 0.0f ? cluster_weight(p, part) : part.pmf;
        chosen = weight > 0.0f ? i : chosen;
        reached += weight;
    }
    return load_cluster_part(s.cluster, chosen);
}

/// A picked light, with the expected number of picks of it, relative to one pick by power.
struct PickedLight {
    uint id;
    float picks;
};

/// Pick number `step` from the clusters. Steps must be increasing. `words` are three random words.
FN PickedLight pick_near_light(INOUT(ClusterSteps) s, IN(CandidatePicker) p, uint step, uvec3 words) {
    step_to(s, p, (float(step) + s.offset) / float(p.near) * p.sum);
    LightCluster part = pick_part(s, p, unit_float(words.z));
    ClusterPick column = load_cluster_picks(part.first + alias_column(words.x, part.count));
    AliasEntry entry;
    entry.probability = column.probability;
    entry.alias = column.alias;
    PickedLight picked;
    picked.id = alias_pick(entry, column.light, words.y);
    picked.picks = picks_of_part(p, s.whole, s.weight, part, s.parts);
    return picked;
}

FN PickedLight pick_light_by_power(IN(CandidatePicker) p, uvec2 words) {
    PickedLight picked;
    picked.id = pick_light_by_power(words);
    picked.picks = picks_of_light(p, picked.id);
    return picked;
}

#endif
