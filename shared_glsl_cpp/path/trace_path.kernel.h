// Traces one whole path, for a backend that traces and shades in one place.
#ifndef TRACE_PATH_KERNEL_H
#define TRACE_PATH_KERNEL_H

#include "path/path.kernel.h"

/// One path from the camera to its end. The Vulkan backend does the same steps in waves (wave.glsl).
FN PathSample trace_path(uvec2 pixel, uint sample_index) {
    PathState path = begin_path(pixel, sample_index);
    while (path.goes_on) {
        extend_path(path, trace_closest(path.origin, path.direction, next_ray_key(path)));
        if (awaits_shadow_ray(path)) {
            settle_direct_light(
                path, trace_any(path.origin, path.direct.direction, path.direct.t_max, shadow_ray_key(path)));
        }
    }
    return path.found;
}

#endif
