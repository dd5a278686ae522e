#version 460
#extension GL_GOOGLE_include_directive : require

#include "resampling_memory.glsl"
#include "restir/resampled_path.kernel.h"
#include "film_store.glsl"
#include "wave_paths.glsl"
#include "wave_lists.glsl"

layout(local_size_x = WAVE_GROUP) in;

// The first vertex takes its light from its reservoir. The path continues from there in waves.
void main() {
    uint i = gl_GlobalInvocationID.x;
    bool goes_on = false;
    if (i < slice_paths()) {
        uvec2 pixel = path_pixel(i);
        PathState path = begin_resampled_path(pixel, dispatch_block.value.pass);
        if (!feature(FEATURE_LATER_VERTICES)) {
            add_to_film(pixel_index(pixel), path.found);
            return;
        }
        store_path(i, path);
        if (feature(FEATURE_FIRST_HIT_LAYERS)) {
            addresses.wave_first_hits.data[i] = path.found.first_hit;
        }
        goes_on = path.goes_on;
    }
    if (feature(FEATURE_LATER_VERTICES)) {
        WaveShadow none;
        append(this_wave(), i, goes_on, false, none);
    }
}
