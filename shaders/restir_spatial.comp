#version 460
#extension GL_GOOGLE_include_directive : require

#define REUSE_WITHOUT_RAYS

#include "region.glsl"
#include "resampling_memory.glsl"
#include "restir/reuse.kernel.h"

void main() {
    if (is_in_region()) {
        reuse_spatial(region_pixel(), dispatch_block.value.pass);
    }
}
