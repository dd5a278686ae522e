#version 460
#extension GL_GOOGLE_include_directive : require

#include "scene_hooks.glsl"
#include "path/path.kernel.h"
#include "wave_paths.glsl"

layout(local_size_x = WAVE_GROUP) in;

// Starts every path at the camera.
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= slice_paths()) {
        return;
    }
    addresses.wave_paths.data[i] = pack_path(begin_path(path_pixel(i), path_sample(i)));
    addresses.wave_queues.data[queue_place(this_wave(), i)] = i;
}
