// Begins a path from the result of the ReSTIR passes (restir.kernel.h). This file traces no rays.
#ifndef RESAMPLED_PATH_KERNEL_H
#define RESAMPLED_PATH_KERNEL_H

#include "path/path.kernel.h"

/// The path of which the first vertex, with its direct light, is taken from memory. The caller traces its next ray, if
/// it continues.
FN PathState begin_resampled_path(uvec2 pixel, IN(ResamplingPass) pass) {
    uint index = pixel_index(pixel);
    PathState path = begin_path(pixel, pass.frame);
    FirstVertex vertex = load_first_vertex(index);
    path.reservoir = load_reservoir(pass.reservoirs, index);
    extend_path(path, vertex.hit);
    path.found.rays += vertex.rays;
    if (vertex.occluded == 0u) {
        path.found.radiance += path.direct.radiance;
    }
    path.direct.radiance = vec3(0.0f, 0.0f, 0.0f);
    return path;
}

#endif
