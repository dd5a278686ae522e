// Camera rays (docs/integrand.md: Film and camera).
#pragma once

#include "oracle/traversal.h"

namespace diptych::core::oracle {

class Random;

/// A ray through film point (x, y) in [0, 1]^2, y down, from a uniform point of the lens.
Ray camera_ray(const World& world, const Camera& camera, double aspect, double x, double y, Random& random);

}  // namespace diptych::core::oracle
