// Points on lights, in a form that resampling can store and evaluate again, from other surfaces and at the previous
// moment.
#ifndef LIGHT_POINT_H
#define LIGHT_POINT_H

#include "language/compat.h"

SHARED_BEGIN

// Kinds of light (light_kind).
CONST uint LIGHT_EMITTER = 0u;  // an emissive triangle
CONST uint LIGHT_PUNCTUAL = 1u;
CONST uint LIGHT_ENVIRONMENT = 2u;

/// A point on a light. `uv` are the barycentrics b1, b2 of an emissive triangle, or direction_uv of the environment.
/// They are unused for a punctual light.
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

/// A light point and its density per uv, including the pick of its light by power; density 0: no sample.
struct LightPointSample {
    LightPoint point;
    float pdf;
};

/// A light point as a reference point sees it, unoccluded. f · radiance · measure is the integrand per unit of uv
/// measure.
struct SeenLight {
    vec3 direction;  // unit
    vec3 radiance;   // arriving; for a punctual light, already divided by r²
    float measure;   // solid angle per uv; 1 for a punctual light; 0: not visible from the reference point
    bool by_chance;  // material sampling may find it: false for punctual lights and emitters with alpha
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
