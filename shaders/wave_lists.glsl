// Compute passes append to a wave's lists here, with one device atomic per workgroup.
#ifndef WAVE_LISTS_GLSL
#define WAVE_LISTS_GLSL

#include "wave.glsl"

shared uint group_rays;
shared uint group_shadows;
shared uint first_ray;
shared uint first_shadow;

// Appends a path if it continues, and its shadow ray if it has one. All invocations of the workgroup have to call
// this.
void append(uint wave, uint path, bool goes_on, bool has_shadow, WaveShadow asked) {
    if (gl_LocalInvocationIndex == 0u) {
        group_rays = 0u;
        group_shadows = 0u;
    }
    barrier();
    uint ray = goes_on ? atomicAdd(group_rays, 1u) : 0u;
    uint shadow = has_shadow ? atomicAdd(group_shadows, 1u) : 0u;
    barrier();
    if (gl_LocalInvocationIndex == 0u && group_rays > 0u) {
        first_ray = atomicAdd(addresses.wave_counts.data[wave].rays.x, group_rays);
        atomicMax(addresses.wave_counts.data[wave].shading.x, (first_ray + group_rays + WAVE_GROUP - 1u) / WAVE_GROUP);
    }
    if (gl_LocalInvocationIndex == 0u && group_shadows > 0u) {
        first_shadow = atomicAdd(addresses.wave_counts.data[wave].shadows.x, group_shadows);
    }
    barrier();
    if (goes_on) {
        addresses.wave_queues.data[queue_place(wave, first_ray + ray)] = path;
    }
    if (has_shadow) {
        addresses.wave_shadows.data[first_shadow + shadow] = asked;
    }
}

#endif
