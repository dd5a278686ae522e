// One path through the scene, by textbook estimators.
#pragma once

#include <span>

#include "oracle/emitters.h"
#include "oracle/lights.h"
#include "oracle/sky.h"
#include "oracle/surface.h"

namespace diptych::core::oracle {

/// How a path finds light. Punctual lights, which no ray meets, are summed or picked uniformly in every mode.
enum class Mode {
    bsdf,        // directions drawn from the material; emission where they lead
    hemisphere,  // uniform directions over the hemisphere; mirrors apart
    area,        // as bsdf, but emissive surfaces by uniform points over their area, save behind a perfect mirror
    mis,         // as bsdf, and at each vertex one point on an emitter by power and one direction by the sky's map,
                 // weighted against the material's directions by the balance heuristic (Veach 1997, eq. 9.8)
};

/// How the mode draws points on emitters.
inline EmitterChoice emitter_choice(Mode mode) {
    return mode == Mode::mis ? EmitterChoice::power : EmitterChoice::area;
}

/// What every path needs; the referred outlive it.
struct Paths {
    const World& world;
    const Traversal& traversal;
    const Emitters& emitters;  // by the mode's choice
    const SkyMap& sky;
    Distribution model = Distribution::ggx;
    Mode mode = Mode::bsdf;
    unsigned max_depth = 8;
    NormalMaps normal_maps = NormalMaps::shading;
};

/// What a ray from the camera met first; zero on a miss.
struct FirstHit {
    dvec3 base_color{0};
    dvec3 normal{0};  // the mapped normal, held above the surface; the bent one where there is no map; world
    double distance = 0;
};

struct PathResult {
    dvec3 radiance{0};
    FirstHit first;
    unsigned rays = 0;
};

/// Follows one camera ray. `by_depth` is empty or has max_depth + 1 elements; to each is added what reached the camera
/// after so many scatterings.
PathResult trace_path(const Paths& paths, Ray ray, Random& random, std::span<dvec3> by_depth);

}  // namespace diptych::core::oracle
