// The only list of the buffers, beside the scene's (language/scene_buffers.h), whose addresses the shaders get: films,
// intermediate results, records. SceneAddresses expands both lists, in GLSL (scene_hooks.glsl) and in C++
// (vk_backend/memory/scene_addresses.h).
#ifndef DEVICE_BUFFERS_H
#define DEVICE_BUFFERS_H

// X(element type, name, alignment of the address, whether shaders write it). Films are words (film_layout.h).
#define DEVICE_ARRAYS(X)                                \
    X(uint, film_pixels, 4, writable)                   \
    X(uint, film_moments, 4, writable)                  \
    X(uint, film_first_hits, 4, writable)               \
    X(FirstVertex, first_vertices, 4, writable)         \
    X(Reservoir, reservoirs, 4, writable)               \
    X(ReuseSurface, reuse_surfaces, 4, writable)        \
    X(RecordedRay, recorded_rays, 16, writable)         \
    X(PathQuery, path_queries, 4, read_only)            \
    X(PathVertexRecord, path_vertices, 16, writable)    \
    X(PathSummary, path_summaries, 16, writable)        \
    X(uvec2, grouped_geometries, 8, read_only)          \
    X(WavePath, wave_paths, 16, writable)               \
    X(FirstHit, wave_first_hits, 4, writable)           \
    X(uint, wave_queues, 4, writable)                   \
    X(Hit, wave_hits, 8, writable)                      \
    X(WaveShadow, wave_shadows, 16, writable)           \
    X(WaveCounts, wave_counts, 4, writable)

// X(name): not arrays; scene_hooks.glsl declares their contents.
#define DEVICE_BLOCKS(X) \
    X(candidate_list)    \
    X(ray_counters)

#endif
