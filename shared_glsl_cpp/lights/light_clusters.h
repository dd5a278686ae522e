// Clusters of lights that are close together. A cluster acts as one source, whose distance gives an estimate of its
// lights' contribution at a point (after Conty Estevez and Kulla 2018; here without a tree: every point visits every
// cluster).
#ifndef LIGHT_CLUSTERS_H
#define LIGHT_CLUSTERS_H

#include "language/scene_types.h"

SHARED_BEGIN

/// Estimate of the light at a surface from a cluster of unit power: cos/r². r² = |x - c|² + E|y - c|² is the mean
/// square distance to the cluster's lights. cos is that of the light highest above the surface.
FN float cluster_falloff(IN(LightCluster) cluster, vec3 position, vec3 normal) {
    vec3 d = cluster.center - position;
    PRECISE float inverse = inversesqrt(dot(d, d) + cluster.spread);
    PRECISE float falloff = max(dot(d, normal) + cluster.radius, 0.0f) * inverse * inverse * inverse;
    return falloff;
}

/// Squared distance from the cluster's center less the square of twice its radius, m². Where it is negative, the point
/// is so near that the cluster's parts have to be weighed one by one.
FN float squared_excess(IN(LightCluster) cluster, vec3 position) {
    vec3 d = cluster.center - position;
    PRECISE float excess = dot(d, d) - 4.0f * cluster.radius * cluster.radius;
    return excess;
}

/// The part of a cluster that a triangle with these flags is in; NONE where it is in none.
FN uint part_of_flags(uint flags) {
    return (flags >> EMITTER_PART_SHIFT) - 1u;
}

SHARED_END

#endif
