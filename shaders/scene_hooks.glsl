// The scene as a kernel reads it (hooks.md): constants, feature(bit) and load_NAME(index).
#ifndef SCENE_HOOKS_GLSL
#define SCENE_HOOKS_GLSL

#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_buffer_reference : require

#include "dispatch.h"
#include "geometry/hit.h"
#include "wave.h"
#include "film/film_pixel.h"
#include "path/path_record.h"
#include "language/scene_buffers.h"
#include "restir/resampling_memory.h"
#include "language/scene_features.h"

#ifndef RECORD
#define RECORD(field, value)
#endif

layout(constant_id = 0) const uint FEATURES = 0xffffffffu;

uint features() { return FEATURES; }
bool feature(uint bit) { return (FEATURES & bit) != 0u; }

// An element's alignment, up to the 16 bytes of the widest load, divides its size.
#define ALIGN_uint 4
#define ALIGN_float 4
#define ALIGN_vec2 8
#define ALIGN_vec3 4
#define ALIGN_uvec3 4
#define ALIGN_vec4 16
#define ALIGN_Instance 4
#define ALIGN_Geometry 16
#define ALIGN_Material 4
#define ALIGN_TextureSlot 8
#define ALIGN_EmissiveTriangle 16
#define ALIGN_PunctualLight 4
#define ALIGN_AliasEntry 8
#define ALIGN_LightCluster 16
#define ALIGN_ClusterPick 4

#define DECLARE_REFERENCE(Type, name)                                                                    \
    layout(buffer_reference, scalar, buffer_reference_align = ALIGN_##Type) readonly buffer name##_buffer { \
        Type data[];                                                                                     \
    };
SCENE_BUFFERS(DECLARE_REFERENCE)
#undef DECLARE_REFERENCE

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer film_pixels_buffer { FilmPixel data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer film_moments_buffer { FilmMoments data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer film_first_hits_buffer { FilmFirstHit data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer first_vertices_buffer { FirstVertex data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer reservoirs_buffer { Reservoir data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer reuse_surfaces_buffer { ReuseSurface data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer candidate_list_buffer {
    uvec3 command;  // indirect, of which x counts
    CandidateRequest entries[];
};
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer recorded_rays_buffer { RecordedRay data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer ray_counters_buffer { RayCounters data; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer path_queries_buffer { PathQuery data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer path_vertices_buffer { PathVertexRecord data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer path_summaries_buffer { PathSummary data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer grouped_geometries_buffer { uvec2 data[]; };

layout(buffer_reference, scalar, buffer_reference_align = 16) buffer wave_paths_buffer { WavePath data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer wave_first_hits_buffer { FirstHit data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer wave_queues_buffer { uint data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer wave_hits_buffer { Hit data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer wave_shadows_buffer { WaveShadow data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer wave_counts_buffer { WaveCounts data[]; };

// Mirrored by vk_backend/memory/scene_addresses.h.
layout(set = 0, binding = 1, scalar) uniform SceneAddresses {
#define DECLARE_ADDRESS(Type, name) name##_buffer name;
    SCENE_BUFFERS(DECLARE_ADDRESS)
#undef DECLARE_ADDRESS
    film_pixels_buffer film_pixels;
    film_moments_buffer film_moments;
    film_first_hits_buffer film_first_hits;
    first_vertices_buffer first_vertices;
    reservoirs_buffer reservoirs;
    reuse_surfaces_buffer reuse_surfaces;
    candidate_list_buffer candidate_list;
    recorded_rays_buffer recorded_rays;
    ray_counters_buffer ray_counters;
    path_queries_buffer path_queries;
    path_vertices_buffer path_vertices;
    path_summaries_buffer path_summaries;
    grouped_geometries_buffer grouped_geometries;
    wave_paths_buffer wave_paths;
    wave_first_hits_buffer wave_first_hits;
    wave_queues_buffer wave_queues;
    wave_hits_buffer wave_hits;
    wave_shadows_buffer wave_shadows;
    wave_counts_buffer wave_counts;
} addresses;

layout(set = 0, binding = 2, scalar) uniform Constants { RenderConstants constants; };

#define DEFINE_LOAD(Type, name) \
    Type load_##name(uint index) { return addresses.name.data[index]; }
SCENE_BUFFERS(DEFINE_LOAD)
#undef DEFINE_LOAD

#endif
