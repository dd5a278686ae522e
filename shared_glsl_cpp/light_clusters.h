// Lights that stand together, as one source whose distance tells what its lights are worth to a point (after Conty Estevez and Kulla
// 2018, flattened: every point looks at every cluster).
#ifndef LIGHT_CLUSTERS_H
#define LIGHT_CLUSTERS_H

#include "scene_types.h"

SHARED_BEGIN

/// About what a surface gets from a cluster of unit power: cos/r² with the mean square r² = |x - c|² + E|y - c|² of the distance to its
/// lights, and the cosine that a light has which stands a radius above the centre.
FN float cluster_falloff(IN(LightCluster) cluster, vec3 position, vec3 normal) {
    vec3 d = cluster.center - position;
    float inverse = inversesqrt(dot(d, d) + cluster.spread);
    return max(dot(d, normal) + cluster.radius, 0.0f) * inverse * inverse * inverse;
}

/// Whether a place is so near, within two radii, that it matters which of the lights are nearest.
FN bool is_near_cluster(IN(LightCluster) cluster, vec3 position, float margin) {
    vec3 d = cluster.center - position;
    return dot(d, d) < 4.0f * cluster.spread + margin * margin;
}

/// The part of a cluster that a triangle of such flags is in, NONE where there are none.
FN uint part_of_flags(uint flags) {
    return (flags >> EMITTER_PART_SHIFT) - 1u;
}

SHARED_END

#endif
