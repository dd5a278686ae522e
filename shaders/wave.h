// Paths between the passes of a wave (wave.glsl), in scalar layout, on both sides of the bus.
#ifndef WAVE_H
#define WAVE_H

#include "language/compat.h"

SHARED_BEGIN

CONST uint WAVE_GROUP = 64u;  // local size of the passes that compute

/// A path on its way. Its pixel and sample are known by its place, and so are its random numbers.
struct WavePath {
    vec3 origin;
    float pdf_direction;
    vec3 direction;
    uint alpha_key;  // of its next ray
    vec3 throughput;
    uint state;  // depth, and WAVE_ flags
    vec3 reference;
    uint rays;  // so far
    vec3 radiance;
    uint padding;  // to a multiple of 16 bytes, so that four words are read at a time
};
ASSERT_SIZE(WavePath, 80);

CONST uint WAVE_ONLY_STRATEGY = 0x80000000u;      // PathState's flags
CONST uint WAVE_LIGHT_IS_COMPLETE = 0x40000000u;
CONST uint WAVE_DEPTH = 0x3fffffffu;

/// A shadow ray, and what its path gains where it is free.
struct WaveShadow {
    vec3 origin;
    float t_max;
    vec3 direction;
    uint alpha_key;
    vec3 radiance;
    uint path;
};
ASSERT_SIZE(WaveShadow, 48);

/// How much there is to do: three indirect commands, of which x counts and y and z are 1.
struct WaveCounts {
    uvec3 rays;     // that paths go on along
    uvec3 shading;  // groups for as many
    uvec3 shadows;
};
ASSERT_SIZE(WaveCounts, 36);

SHARED_END

#endif
