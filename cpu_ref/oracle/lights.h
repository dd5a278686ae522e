// Light that rays cannot meet, light from infinity, and emissive triangles by area (docs/integrand.md: Emission, Lights).
#pragma once

#include <vector>

#include "oracle/traversal.h"

namespace diptych::oracle {

class Random;

/// A punctual light seen from a point: irradiance across the direction to it, and how far it is.
struct PunctualSample {
    dvec3 direction;  // unit, to the light
    double distance;  // infinite where directional
    dvec3 irradiance;
};

PunctualSample sample_punctual(const World& world, const PunctualLight& light, const dvec3& position);

/// Radiance that arrives along a ray of this direction from infinity.
dvec3 environment_radiance(const Environment& environment, const dvec3& direction);

/// All triangles that may emit.
class Emitters {
public:
    explicit Emitters(const World& world);

    struct Point {
        std::size_t triangle;
        dvec2 barycentrics;
    };

    bool empty() const { return triangles_.empty(); }
    /// Square metres.
    double total_area() const { return empty() ? 0 : area_up_to_.back(); }
    /// Uniform over the area of all.
    Point sample(Random& random) const;

private:
    std::vector<std::size_t> triangles_;
    std::vector<double> area_up_to_;
};

}  // namespace diptych::oracle
