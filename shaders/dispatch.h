// What one dispatch is told, and what a recorded ray is; in scalar layout, on both sides of the bus.
#ifndef DISPATCH_H
#define DISPATCH_H

#include "restir/resampling_memory.h"

SHARED_BEGIN

CONST uint REGION_SIDE = 8u;  // pixels, of a group of a compute shader over a region

/// The push constants: which pixels and samples; when rays or paths are recorded, for how much there is room.
struct Dispatch {
    uvec2 origin;  // first pixel
    uint first_sample;
    uint sample_count;
    uint ray_capacity;
    uint first_ray;          // of this dispatch, when recorded rays are traced again
    uint first_path;         // of this dispatch, when listed paths are traced
    uint vertices_per_path;  // that are kept of each
    uvec2 region;            // pixels of the slice
    uint path_capacity;      // that there is room for in a queue
    uint wave;               // since the submission began
    ResamplingPass pass;
};
ASSERT_SIZE(Dispatch, 72);

/// One ray as the integrator asked for it.
struct RecordedRay {
    vec3 origin;
    float t_max;  // negative: the closest hit along the whole ray; else any hit before it
    vec3 direction;
    uint alpha_key;
};
ASSERT_SIZE(RecordedRay, 32);

struct RayCounters {
    uint closest;     // rays asked for, whether or not there was room: kept from the front
    uint any;         // the same, kept from the back
    uint impossible;  // written where a trace answers what it cannot, so that no trace is dropped as unused
};
ASSERT_SIZE(RayCounters, 12);

SHARED_END

#endif
