// trace_closest and trace_any (hooks.md) for ray generation shaders. On request they also record every ray.
#ifndef TRACE_HOOKS_GLSL
#define TRACE_HOOKS_GLSL

#include "dispatch_block.glsl"
#include "payload.glsl"

layout(constant_id = 1) const uint RECORD_RAYS = 0u;

layout(set = 0, binding = 0) uniform accelerationStructureEXT scene_structure;

layout(location = CLOSEST_PAYLOAD) rayPayloadEXT Hit closest_payload;
layout(location = SHADOW_PAYLOAD) rayPayloadEXT ShadowPayload shadow_payload;

// Appends a ray. Neighbours in the list were traced at about the same time, for the same purpose, by neighbouring
// pixels.
void record_ray(vec3 origin, vec3 direction, float t_max, uint alpha_key) {
    uint capacity = dispatch_block.value.ray_capacity;
    uint slot = 0u;
    if (t_max < 0.0f) {
        slot = atomicAdd(addresses.ray_counters.data.closest, 1u);
    } else {
        slot = capacity - 1u - atomicAdd(addresses.ray_counters.data.any, 1u);
    }
    if (slot < capacity) {
        RecordedRay ray;
        ray.origin = origin;
        ray.t_max = t_max;
        ray.direction = direction;
        ray.alpha_key = alpha_key;
        addresses.recorded_rays.data[slot] = ray;
    }
}

uint opacity_flags() { return feature(FEATURE_ALPHA) ? gl_RayFlagsNoneEXT : gl_RayFlagsOpaqueEXT; }

Hit trace_closest(vec3 origin, vec3 direction, uint alpha_key) {
    if (RECORD_RAYS != 0u) {
        record_ray(origin, direction, -1.0f, alpha_key);
    }
    closest_payload.instance = alpha_key;
    traceRayEXT(scene_structure, opacity_flags(), 0xffu, 0u, 0u, 0u, origin, 0.0f, direction, INFINITE_DISTANCE,
                CLOSEST_PAYLOAD);
    return closest_payload;
}

// The nearest hit or, with `any`, some hit before t_max. With `any` only `instance` is defined; it is NONE without a
// hit.
Hit trace_either(vec3 origin, vec3 direction, float t_max, bool any, uint alpha_key) {
    if (RECORD_RAYS != 0u) {
        record_ray(origin, direction, any ? t_max : -1.0f, alpha_key);
    }
    uint flags = any ? gl_RayFlagsTerminateOnFirstHitEXT | gl_RayFlagsSkipClosestHitShaderEXT : 0u;
    closest_payload.instance = alpha_key;  // remains, and is not NONE, if a hit skips the closest-hit shader
    traceRayEXT(scene_structure, opacity_flags() | flags, 0xffu, 0u, 0u, 0u, origin, 0.0f, direction, t_max,
                CLOSEST_PAYLOAD);
    return closest_payload;
}

bool trace_any(vec3 origin, vec3 direction, float t_max, uint alpha_key) {
    if (RECORD_RAYS != 0u) {
        record_ray(origin, direction, t_max, alpha_key);
    }
    shadow_payload.alpha_key = alpha_key;
    shadow_payload.missed = 0u;
    traceRayEXT(scene_structure,
                opacity_flags() | gl_RayFlagsTerminateOnFirstHitEXT | gl_RayFlagsSkipClosestHitShaderEXT, 0xffu, 1u, 0u,
                1u, origin, 0.0f, direction, t_max, SHADOW_PAYLOAD);
    return shadow_payload.missed == 0u;
}

#endif
