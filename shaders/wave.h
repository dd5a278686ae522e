// Paths between the passes of a wave (wave.glsl), in scalar layout for GLSL and C++.
#ifndef WAVE_H
#define WAVE_H

#include "language/compat.h"

SHARED_BEGIN

CONST uint WAVE_GROUP = 64u;  // workgroup size of the compute passes

/// A path in progress. Its pixel, sample and random numbers follow from its index.
struct WavePath {
    vec3 origin;
    float pdf_direction;
    vec3 direction;
    uint alpha_key;  // of the path's next ray
    vec3 throughput;
    uint state;  // depth, and WAVE_… flags
    vec3 reference;
    uint rays;  // traced so far
    vec3 radiance;
    uint facing;  // a multiple of 16 bytes ends here, so that loads are four words wide
};
ASSERT_SIZE(WavePath, 80);

CONST uint WAVE_ONLY_STRATEGY = 0x80000000u;      // flags of PathState
CONST uint WAVE_LIGHT_IS_COMPLETE = 0x40000000u;
CONST uint WAVE_DEPTH = 0x3fffffffu;

/// A shadow ray, and the radiance that its path gains if the ray is unoccluded.
struct WaveShadow {
    vec3 origin;
    float t_max;
    vec3 direction;
    uint alpha_key;
    vec3 radiance;
    uint path;
};
ASSERT_SIZE(WaveShadow, 48);

/// The work of a wave: three indirect commands; x is a count, y and z are 1.
struct WaveCounts {
    uvec3 rays;     // rays of paths that continue
    uvec3 shading;  // workgroups for as many paths
    uvec3 shadows;
};
ASSERT_SIZE(WaveCounts, 36);

SHARED_END

#endif
