// Which instance of the scene, and which geometry of its mesh, a hit shader was called for.
#ifndef HIT_IDS_GLSL
#define HIT_IDS_GLSL

#include "scene_hooks.glsl"

layout(constant_id = 2) const uint GROUPS = 0u;

// A group of instances is one instance to the device. Its custom index is one more than its first entry of the table; that of others is 0,
// and their place among the device's instances is that among the scene's.
uvec2 hit_ids() {
    if (GROUPS != 0u && gl_InstanceCustomIndexEXT != 0) {
        return addresses.grouped_geometries.data[gl_InstanceCustomIndexEXT - 1 + gl_GeometryIndexEXT];
    }
    return uvec2(gl_InstanceID, gl_GeometryIndexEXT);
}

#endif
