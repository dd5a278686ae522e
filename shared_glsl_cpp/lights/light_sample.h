// The result of sampling a light for a path.
#ifndef LIGHT_SAMPLE_H
#define LIGHT_SAMPLE_H

#include "language/compat.h"

SHARED_BEGIN

/// A light that was picked, with the probability of that pick.
struct LightPick {
    uint id;  // NONE: no light
    float pmf;
};

FN LightPick no_light_pick() {
    LightPick pick;
    pick.id = NONE;
    pick.pmf = 0.0f;
    return pick;
}

/// A point on a light as `reference` sees it.
struct LightSample {
    vec3 direction;  // unit, toward the light
    vec3 radiance;   // arriving, unoccluded; for a delta light, already divided by r²
    float pdf;       // per solid angle, times the pick; for a delta light, the pick alone; 0: no sample
    bool delta;      // no other strategy can find the light
    bool distant;    // at infinity; `end` is unused
    vec3 end;        // where the shadow ray ends, offset from the light's surface
};

FN LightSample no_light() {
    LightSample s;
    s.direction = vec3(0.0f, 0.0f, 1.0f);
    s.radiance = vec3(0.0f, 0.0f, 0.0f);
    s.pdf = 0.0f;
    s.delta = false;
    s.distant = false;
    s.end = vec3(0.0f, 0.0f, 0.0f);
    return s;
}

SHARED_END

#endif
