// The only list of a scene's arrays. Each backend expands it: to bounds-asserted spans on the CPU; to buffer
// references, uploads and the memory report on the GPU. Kernels read elements through `load_NAME(index)` (hooks.md).
#ifndef SCENE_BUFFERS_H
#define SCENE_BUFFERS_H

#include "language/scene_types.h"

// X(element type, name)
#define SCENE_BUFFERS(X)                    \
    X(vec3, positions)                      \
    X(uvec3, triangles)                     \
    X(vec3, normals)                        \
    X(vec4, tangents)                       \
    X(vec2, uvs)                            \
    X(vec4, colors)                         \
    X(Instance, instances)                  \
    X(Geometry, geometries)                 \
    X(Material, materials)                  \
    X(TextureSlot, texture_slots)           \
    X(uint, texels)                         \
    X(float, srgb_table)                    \
    X(uint, emitter_slots)                  \
    X(EmissiveTriangle, emissive_triangles) \
    X(PunctualLight, punctual_lights)       \
    X(AliasEntry, light_table)              \
    X(LightCluster, light_clusters)         \
    X(ClusterPick, cluster_picks)           \
    X(LightNode, light_nodes)               \
    X(LightPlace, light_places)             \
    X(LeafPick, leaf_picks)                 \
    X(vec4, environment_texels)             \
    X(AliasEntry, environment_table)        \
    X(Instance, previous_instances)         \
    X(EmissiveTriangle, previous_emissive_triangles) \
    X(PunctualLight, previous_punctual_lights)

// The arrays that differ between two moments of an animated scene.
#define MOVING_BUFFERS(X)                   \
    X(Instance, instances)                  \
    X(Material, materials)                  \
    X(EmissiveTriangle, emissive_triangles) \
    X(PunctualLight, punctual_lights)       \
    X(AliasEntry, light_table)              \
    X(LightCluster, light_clusters)         \
    X(ClusterPick, cluster_picks)           \
    X(LightNode, light_nodes)               \
    X(LightPlace, light_places)             \
    X(LeafPick, leaf_picks)                 \
    X(Instance, previous_instances)         \
    X(EmissiveTriangle, previous_emissive_triangles) \
    X(PunctualLight, previous_punctual_lights)

#endif
