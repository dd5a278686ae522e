// The scene's instance, and the geometry of its mesh, that a hit shader was called for.
#ifndef HIT_IDS_GLSL
#define HIT_IDS_GLSL

#include "scene_hooks.glsl"

layout(constant_id = 2) const uint GROUPS = 0u;

// A group of instances is a single instance for the device. Its custom index is 1 + the index of its first entry in
// the table. An instance that is not grouped has custom index 0, and its device index is its scene index.
uvec2 hit_ids() {
    if (GROUPS != 0u && gl_InstanceCustomIndexEXT != 0) {
        return addresses.grouped_geometries.data[gl_InstanceCustomIndexEXT - 1 + gl_GeometryIndexEXT];
    }
    return uvec2(gl_InstanceID, gl_GeometryIndexEXT);
}

#endif
