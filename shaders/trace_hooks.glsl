// trace_closest and trace_any (hooks.md) for ray generation shaders; on request they also record every ray.
#ifndef TRACE_HOOKS_GLSL
#define TRACE_HOOKS_GLSL

#include "scene_hooks.glsl"
#include "payload.glsl"

layout(constant_id = 1) const uint RECORD_RAYS = 0u;

layout(push_constant, scalar) uniform DispatchBlock { Dispatch value; } dispatch_block;

layout(set = 0, binding = 0) uniform accelerationStructureEXT scene_structure;

layout(location = CLOSEST_PAYLOAD) rayPayloadEXT Hit closest_payload;
layout(location = SHADOW_PAYLOAD) rayPayloadEXT ShadowPayload shadow_payload;

uint recorded_counts[2] = uint[2](0u, 0u);  // closest, any

void record_ray(vec3 origin, vec3 direction, float t_max, uint alpha_key) {
    uint kind = t_max < 0.0f ? 0u : 1u;
    uint place = recorded_counts[kind];
    uint lane = dispatch_block.value.first_lane + gl_LaunchIDEXT.y * gl_LaunchSizeEXT.x + gl_LaunchIDEXT.x;
    if (place < dispatch_block.value.ray_capacity) {
        RecordedRay ray;
        ray.origin = origin;
        ray.t_max = t_max;
        ray.direction = direction;
        ray.alpha_key = alpha_key;
        uint row = kind * dispatch_block.value.ray_capacity + place;
        addresses.recorded_rays.data[row * dispatch_block.value.lane_count + lane] = ray;
        atomicAdd(addresses.ray_counters.data.recorded, 1u);
    } else {
        atomicAdd(addresses.ray_counters.data.dropped, 1u);
    }
    recorded_counts[kind] = place + 1u;
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
