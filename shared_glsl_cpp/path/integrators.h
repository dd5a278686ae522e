// The integrators, and what each of them does: the one place that knows which strategies belong to which integrator. `integrator` is
// RenderConstants::integrator.
#ifndef INTEGRATORS_H
#define INTEGRATORS_H

#include "language/compat.h"

SHARED_BEGIN

CONST uint INTEGRATOR_BRDF = 0u;    // finds light by sampling the material
CONST uint INTEGRATOR_DIRECT = 1u;  // finds light by sampling lights
CONST uint INTEGRATOR_PATH = 2u;    // by both
CONST uint INTEGRATOR_RIS = 3u;     // `path` whose first vertex picks among many light candidates
CONST uint INTEGRATOR_RESTIR = 4u;  // `ris` that also reuses what neighbours in time and space picked

/// Whether light that a ray along a sampled direction of the material finds is counted. What no other strategy can find (lights seen
/// directly or in a mirror) is counted by every integrator.
FN bool samples_material(uint integrator) {
    return integrator != INTEGRATOR_DIRECT;
}

/// Whether every light is sampled. Punctual lights, which no other strategy can find, are sampled by every integrator.
FN bool samples_lights(uint integrator) {
    return integrator != INTEGRATOR_BRDF;
}

/// Whether two strategies find the same light, so that MIS has to weigh them.
FN bool weighs_by_mis(uint integrator) {
    return samples_material(integrator) && samples_lights(integrator);
}

/// Whether the first vertex takes its direct light from a reservoir.
FN bool resamples_lights(uint integrator) {
    return integrator == INTEGRATOR_RIS || integrator == INTEGRATOR_RESTIR;
}

/// Whether reservoirs merge those of neighbours and of the frame before.
FN bool reuses_reservoirs(uint integrator) {
    return integrator == INTEGRATOR_RESTIR;
}

SHARED_END

#endif
