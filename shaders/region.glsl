// A compute shader over the pixels of a slice's region, in squares: 32 invocations access more similar data in a
// square than in a row.
#ifndef REGION_GLSL
#define REGION_GLSL

#include "dispatch_block.glsl"

layout(local_size_x = REGION_SIDE, local_size_y = REGION_SIDE) in;

bool is_in_region() { return all(lessThan(gl_GlobalInvocationID.xy, dispatch_block.value.region)); }
uvec2 region_pixel() { return dispatch_block.value.origin + gl_GlobalInvocationID.xy; }

#endif
