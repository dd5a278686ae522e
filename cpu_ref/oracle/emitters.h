// Points on emissive triangles (docs/integrand.md: Emission).
#pragma once

#include <vector>

#include "oracle/world.h"

namespace diptych::core::oracle {

class Random;

/// What the chance of a triangle goes by. Its points are uniform under either.
enum class EmitterChoice {
    area,
    power,  // area times the emission before its texture
};

/// All triangles that may emit.
class Emitters {
public:
    Emitters(const World& world, EmitterChoice choice);

    struct Point {
        std::size_t triangle;
        dvec2 barycentrics;
        double density;  // a square metre
    };

    /// Whether there is nothing to draw from.
    bool empty() const { return !(total() > 0); }
    /// Needs an emitter.
    Point sample(Random& random) const;
    /// Of `sample`'s points on the triangle, a square metre; 0 where it never goes.
    double density(std::size_t triangle) const { return empty() ? 0 : brightness_[triangle] / total(); }

private:
    double total() const { return weight_up_to_.empty() ? 0 : weight_up_to_.back(); }

    std::vector<double> brightness_;  // of each triangle of the world: its weight a square metre
    std::vector<std::size_t> triangles_;
    std::vector<double> weight_up_to_;
};

}  // namespace diptych::core::oracle
