// A light so far away that its rays are parallel, added to whatever a scene has.
#pragma once

#include "scene/scene.h"

namespace diptych::core {

struct Sun {
    double azimuth = 0;     // degrees from -Z, the middle of an environment map, toward +X: clockwise from above
    double elevation = 45;  // degrees above the horizon
    double irradiance = 1;  // W/m^2, of a surface that faces it

    bool operator==(const Sun&) const = default;
};

/// White and directional.
PunctualLight sun_light(const Sun& sun);

}  // namespace diptych::core
