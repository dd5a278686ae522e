// What resampling keeps between its passes (hooks.md).
#ifndef RESAMPLING_HOOKS_GLSL
#define RESAMPLING_HOOKS_GLSL

#include "trace_hooks.glsl"

uint film_pixel_count() { return constants.size.x * constants.size.y; }

FirstVertex load_first_vertex(uint index) { return addresses.first_vertices.data[index]; }
void store_first_vertex(uint index, FirstVertex vertex) { addresses.first_vertices.data[index] = vertex; }
Reservoir load_reservoir(uint set, uint index) { return addresses.reservoirs.data[set * film_pixel_count() + index]; }
void store_reservoir(uint set, uint index, Reservoir r) {
    addresses.reservoirs.data[set * film_pixel_count() + index] = r;
}
ReuseSurface load_reuse_surface(uint set, uint index) {
    return addresses.reuse_surfaces.data[set * film_pixel_count() + index];
}
void store_reuse_surface(uint set, uint index, ReuseSurface s) {
    addresses.reuse_surfaces.data[set * film_pixel_count() + index] = s;
}

layout(set = 0, binding = 3) uniform accelerationStructureEXT previous_structure;

bool trace_any_previous(vec3 origin, vec3 direction, float t_max, uint alpha_key) {
    shadow_payload.alpha_key = alpha_key;
    shadow_payload.missed = 0u;
    traceRayEXT(previous_structure,
                opacity_flags() | gl_RayFlagsTerminateOnFirstHitEXT | gl_RayFlagsSkipClosestHitShaderEXT, 0xffu, 1u, 0u,
                1u, origin, 0.0f, direction, t_max, SHADOW_PAYLOAD);
    return shadow_payload.missed == 0u;
}

uvec2 launch_pixel() { return dispatch_block.value.origin + gl_LaunchIDEXT.xy; }

#endif
