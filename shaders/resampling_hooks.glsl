// Hooks of resampling beside resampling_memory.glsl: the structures of the previous moment and of the emitters
// (hooks.md).
#ifndef RESAMPLING_HOOKS_GLSL
#define RESAMPLING_HOOKS_GLSL

#include "resampling_memory.glsl"
#include "trace_hooks.glsl"

layout(set = 0, binding = 3) uniform accelerationStructureEXT previous_structure;
layout(set = 0, binding = 4) uniform accelerationStructureEXT emitter_structure;

bool trace_any_previous(vec3 origin, vec3 direction, float t_max, uint alpha_key) {
    shadow_payload.alpha_key = alpha_key;
    shadow_payload.missed = 0u;
    traceRayEXT(previous_structure,
                opacity_flags() | gl_RayFlagsTerminateOnFirstHitEXT | gl_RayFlagsSkipClosestHitShaderEXT, 0xffu, 1u, 0u,
                1u, origin, 0.0f, direction, t_max, SHADOW_PAYLOAD);
    return shadow_payload.missed == 0u;
}

LightPoint trace_emitters(vec3 origin, vec3 direction, float t_max) {
    traceRayEXT(emitter_structure, gl_RayFlagsOpaqueEXT, 0xffu, 0u, 0u, 0u, origin, 0.0f, direction, t_max,
                CLOSEST_PAYLOAD);
    LightPoint y;
    y.light = closest_payload.instance == NONE ? NONE : closest_payload.primitive;
    y.uv = closest_payload.barycentrics;
    return y;
}

uvec2 launch_pixel() { return dispatch_block.value.origin + gl_LaunchIDEXT.xy; }

#endif
