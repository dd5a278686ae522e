// The integrators and their strategies. This file alone knows which integrator uses which strategy. `integrator` is
// RenderConstants::integrator.
#ifndef INTEGRATORS_H
#define INTEGRATORS_H

#include "language/compat.h"

SHARED_BEGIN

CONST uint INTEGRATOR_BRDF = 0u;    // finds light by sampling the material
CONST uint INTEGRATOR_DIRECT = 1u;  // finds light by sampling lights
CONST uint INTEGRATOR_PATH = 2u;    // uses both strategies, weighted by MIS
CONST uint INTEGRATOR_RIS = 3u;     // `path`, but the first vertex selects among many light candidates
CONST uint INTEGRATOR_RESTIR = 4u;  // `ris`, and reuses the selections of neighbours and of the frame before

/// Whether light counts that a ray finds by sampling the material. Light that no other strategy can find (lights seen
/// directly or in a mirror) counts in every integrator.
FN bool samples_material(uint integrator) {
    return integrator != INTEGRATOR_DIRECT;
}

/// Whether every light is sampled. Punctual lights, which no other strategy can find, are sampled in every integrator.
FN bool samples_lights(uint integrator) {
    return integrator != INTEGRATOR_BRDF;
}

/// Whether two strategies find the same light, so that MIS weighs them.
FN bool weighs_by_mis(uint integrator) {
    return samples_material(integrator) && samples_lights(integrator);
}

/// Whether the first vertex takes its direct light from a reservoir.
FN bool resamples_lights(uint integrator) {
    return integrator == INTEGRATOR_RIS || integrator == INTEGRATOR_RESTIR;
}

/// Whether reservoirs of neighbours and of the frame before are merged.
FN bool reuses_reservoirs(uint integrator) {
    return integrator == INTEGRATOR_RESTIR;
}

SHARED_END

#endif
