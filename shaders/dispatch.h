// What one dispatch is told, and what a recorded ray is; in scalar layout, on both sides of the bus.
#ifndef DISPATCH_H
#define DISPATCH_H

#include "compat.h"

SHARED_BEGIN

/// The push constants: which pixels and samples; when rays are recorded, where they go.
struct Dispatch {
    uvec2 origin;        // first pixel
    uint first_sample;
    uint sample_count;
    uint first_lane;     // of this dispatch's first pixel; a lane is one path
    uint lane_count;     // of all dispatches; a lane's k-th closest-hit ray is at k * lane_count + lane, its
                         // k-th any-hit ray at (ray_capacity + k) * lane_count + lane
    uint ray_capacity;   // rays of each kind that a lane can keep
    uint first_ray;      // of this dispatch, when recorded rays are traced again
};
ASSERT_SIZE(Dispatch, 32);

/// One ray as the integrator asked for it.
struct RecordedRay {
    vec3 origin;
    float t_max;  // negative: the closest hit along the whole ray; 0: no ray here; else any hit before it
    vec3 direction;
    uint alpha_key;
};
ASSERT_SIZE(RecordedRay, 32);

CONST uint HIT_COUNTERS = 1024u;

struct RayCounters {
    uint recorded;
    uint dropped;             // beyond a lane's capacity
    uint hits[HIT_COUNTERS];  // when traced again; many counters, so that they are not waited for
};
ASSERT_SIZE(RayCounters, 4104);

SHARED_END

#endif
