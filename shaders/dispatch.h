// The parameters of one dispatch, and a recorded ray, in scalar layout for GLSL and C++.
#ifndef DISPATCH_H
#define DISPATCH_H

#include "restir/resampling_memory.h"

SHARED_BEGIN

CONST uint REGION_SIDE = 8u;  // pixels; side of a compute shader's workgroup over a region

/// The push constants: the pixels and samples, and the room for recorded rays or paths.
struct Dispatch {
    uvec2 origin;  // first pixel
    uint first_sample;
    uint sample_count;
    uint ray_capacity;
    uint first_ray;          // first ray of this dispatch, when recorded rays are traced again
    uint first_path;         // first path of this dispatch, when listed paths are traced
    uint vertices_per_path;  // number of vertices kept for each path
    uvec2 region;            // pixels of the slice
    uint path_capacity;      // room in a queue of paths
    uint wave;               // index since the submission began
    ResamplingPass pass;
};
ASSERT_SIZE(Dispatch, 72);

/// One ray that an integrator traced.
struct RecordedRay {
    vec3 origin;
    float t_max;  // negative: the closest hit along the whole ray; else any hit before t_max
    vec3 direction;
    uint alpha_key;
};
ASSERT_SIZE(RecordedRay, 32);

struct RayCounters {
    uint closest;     // number of closest-hit rays, even without room for them; stored from the front
    uint any;         // number of any-hit rays, likewise; stored from the back
    uint impossible;  // written for an impossible result, so that no trace is optimised away
};
ASSERT_SIZE(RayCounters, 12);

SHARED_END

#endif
