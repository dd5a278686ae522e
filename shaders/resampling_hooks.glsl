// What passes of resampling find beside resampling_memory.glsl: the structure of the moment before (hooks.md).
#ifndef RESAMPLING_HOOKS_GLSL
#define RESAMPLING_HOOKS_GLSL

#include "resampling_memory.glsl"
#include "trace_hooks.glsl"

layout(set = 0, binding = 3) uniform accelerationStructureEXT previous_structure;

bool trace_any_previous(vec3 origin, vec3 direction, float t_max, uint alpha_key) {
    shadow_payload.alpha_key = alpha_key;
    shadow_payload.missed = 0u;
    traceRayEXT(previous_structure,
                opacity_flags() | gl_RayFlagsTerminateOnFirstHitEXT | gl_RayFlagsSkipClosestHitShaderEXT, 0xffu, 1u, 0u,
                1u, origin, 0.0f, direction, t_max, SHADOW_PAYLOAD);
    return shadow_payload.missed == 0u;
}

Hit trace_within(vec3 origin, vec3 direction, float t_max, uint alpha_key) {
    return trace_either(origin, direction, t_max, false, alpha_key);
}

uvec2 launch_pixel() { return dispatch_block.value.origin + gl_LaunchIDEXT.xy; }

#endif
