// Lights that stand together, as one source whose distance tells what its lights are worth to a point (after Conty Estevez and Kulla
// 2018, flattened: every point looks at every cluster).
#ifndef LIGHT_CLUSTERS_H
#define LIGHT_CLUSTERS_H

#include "language/scene_types.h"

SHARED_BEGIN

/// About what a surface gets from a cluster of unit power: cos/r² with the mean square r² = |x - c|² + E|y - c|² of the distance to its
/// lights, and the cosine of the highest of them.
FN float cluster_falloff(IN(LightCluster) cluster, vec3 position, vec3 normal) {
    vec3 d = cluster.center - position;
    PRECISE float inverse = inversesqrt(dot(d, d) + cluster.spread);
    PRECISE float falloff = max(dot(d, normal) + cluster.radius, 0.0f) * inverse * inverse * inverse;
    return falloff;
}

/// The square of a place's distance from a cluster less that of two radii, m². Where it is negative it matters which of the lights are nearest.
FN float squared_excess(IN(LightCluster) cluster, vec3 position) {
    vec3 d = cluster.center - position;
    PRECISE float excess = dot(d, d) - 4.0f * cluster.radius * cluster.radius;
    return excess;
}

/// The part of a cluster that a triangle of such flags is in, NONE where there are none.
FN uint part_of_flags(uint flags) {
    return (flags >> EMITTER_PART_SHIFT) - 1u;
}

SHARED_END

#endif
