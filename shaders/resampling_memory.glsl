// The memory of resampling between its passes (hooks.md).
#ifndef RESAMPLING_MEMORY_GLSL
#define RESAMPLING_MEMORY_GLSL

#include "scene_hooks.glsl"

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

#endif
