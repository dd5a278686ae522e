// The push constants. Hit shaders have none, so this file is separate from what all shaders include.
#ifndef DISPATCH_BLOCK_GLSL
#define DISPATCH_BLOCK_GLSL

#include "scene_hooks.glsl"

layout(push_constant, scalar) uniform DispatchBlock { Dispatch value; } dispatch_block;

#endif
