// Whether a scene is lit by what is in it, or would come out black (docs/decisions/0018-the-default-sky.md).
#pragma once

#include "scene/scene.h"

namespace diptych::core {

enum class OwnLight {
    absent,    // nothing emits
    too_weak,  // something emits, but leaves the scene's own views dark: labels, displays, tail lights
    enough,
};

/// What lights a view, measured at the points that it shows and that reflect light. In units of what a white sky of
/// radiance 1 gives; nothing is taken to stand between an emitter and a point.
struct LightOfView {
    double lamps = 0;       // irradiance from emission above 1, at the brightest tenth of the points: its lower bound
    double brightness = 0;  // irradiance from all emission and the point's own emission; median
    double enclosure = 0;   // share of the hemisphere, weighted by the cosine, that emitters fill; median
    std::size_t points = 0;
};

/// Of one view of the scene, without its punctual lights and its environment.
LightOfView light_of_view(const Scene& scene, const Camera& camera);

/// Of the scene at rest, seen through its own cameras, or through one that frames it where they see nothing. It depends
/// on the scene alone, so that every view of a scene has the same light.
OwnLight own_light(const Scene& scene);

}  // namespace diptych::core
