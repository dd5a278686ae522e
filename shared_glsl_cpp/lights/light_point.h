// Points on lights, named so that resampling can keep them and look at them again: from other surfaces, and at the moment before.
#ifndef LIGHT_POINT_H
#define LIGHT_POINT_H

#include "language/compat.h"

SHARED_BEGIN

// Kinds of light (light_kind).
CONST uint LIGHT_EMITTER = 0u;  // an emissive triangle
CONST uint LIGHT_PUNCTUAL = 1u;
CONST uint LIGHT_ENVIRONMENT = 2u;

/// A point on a light: `uv` are barycentrics b1, b2 of an emissive triangle; of the environment, direction_uv; of a punctual light,
/// nothing.
struct LightPoint {
    uint light;  // NONE: no point
    vec2 uv;
};
ASSERT_SIZE(LightPoint, 12);

FN LightPoint no_light_point() {
    LightPoint y;
    y.light = NONE;
    y.uv = vec2(0.0f, 0.0f);
    return y;
}

/// A light point, and its density per uv with the pick of its light by power; 0: none.
struct LightPointSample {
    LightPoint point;
    float pdf;
};

/// A light point as a reference point sees it, unoccluded. f · radiance · measure is the integrand per unit of uv measure.
struct SeenLight {
    vec3 direction;  // unit
    vec3 radiance;   // arriving; of a punctual light: already divided by r²
    float measure;   // solid angle per uv; 1 for punctual lights; 0: the point cannot be seen from there
    bool by_chance;  // a ray that material sampling sends there always finds it: no punctual light, no emitter with alpha
    bool distant;
    vec3 end;        // where the shadow ray ends, offset from the light's surface
};

FN SeenLight unseen_light() {
    SeenLight s;
    s.direction = vec3(0.0f, 0.0f, 1.0f);
    s.radiance = vec3(0.0f, 0.0f, 0.0f);
    s.measure = 0.0f;
    s.by_chance = false;
    s.distant = false;
    s.end = vec3(0.0f, 0.0f, 0.0f);
    return s;
}

SHARED_END

#endif
