// Light from infinity, and directions drawn by its map (docs/integrand.md: Lights without surface).
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/scene.h"

namespace diptych::core::oracle {

using glm::dvec2;
using glm::dvec3;

class Random;

/// Radiance that arrives along a ray of this direction from infinity.
dvec3 environment_radiance(const Environment& environment, const dvec3& direction);

/// Directions by an environment map's radiance: a texel by the sum of its channels times the sine of its polar angle,
/// then a point of the tent around the texel's centre, so that the density is bilinear as the radiance is, and positive
/// wherever that is.
class SkyMap {
public:
    /// Empty where the environment is no map, or black. The environment must outlive it.
    explicit SkyMap(const Environment& environment);

    struct Direction {
        dvec3 direction;
        double density;  // a steradian
    };

    bool empty() const { return weight_up_to_.empty(); }
    /// Needs a map.
    Direction sample(Random& random) const;
    /// Of `sample`'s directions, a steradian; 0 without a map.
    double density(const dvec3& direction) const;

private:
    const Environment& environment_;
    std::vector<double> weight_up_to_;  // by texel; empty where there is nothing to draw from
};

}  // namespace diptych::core::oracle
