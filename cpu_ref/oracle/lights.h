// Light that rays cannot meet (docs/integrand.md: Lights without surface).
#pragma once

#include "oracle/world.h"

namespace diptych::core::oracle {

/// A punctual light seen from a point: irradiance across the direction to it, and how far it is.
struct PunctualSample {
    dvec3 direction;  // unit, to the light
    double distance;  // infinite where directional
    dvec3 irradiance;
};

PunctualSample sample_punctual(const World& world, const PunctualLight& light, const dvec3& position);

}  // namespace diptych::core::oracle
