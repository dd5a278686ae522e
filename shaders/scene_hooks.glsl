// The hooks for reading the scene (hooks.md): constants, feature(bit) and load_NAME(index).
#ifndef SCENE_HOOKS_GLSL
#define SCENE_HOOKS_GLSL

#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_buffer_reference : require

#include "device_buffers.h"
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

// An alignment has to divide the element's size. The widest load is 16 bytes.
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
#define ALIGN_LightNode 16
#define ALIGN_LeafPick 4
#define ALIGN_LightPlace 8

#define DECLARE_REFERENCE(Type, name)                                                                    \
    layout(buffer_reference, scalar, buffer_reference_align = ALIGN_##Type) readonly buffer name##_buffer { \
        Type data[];                                                                                     \
    };
SCENE_BUFFERS(DECLARE_REFERENCE)
#undef DECLARE_REFERENCE

#define ACCESS_writable
#define ACCESS_read_only readonly

#define DECLARE_REFERENCE(Type, name, alignment, access)                                                                 \
    layout(buffer_reference, scalar, buffer_reference_align = alignment) ACCESS_##access buffer name##_buffer { Type data[]; };
DEVICE_ARRAYS(DECLARE_REFERENCE)
#undef DECLARE_REFERENCE

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer candidate_list_buffer {
    uvec3 command;  // indirect dispatch; x counts the entries
    CandidateRequest entries[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer ray_counters_buffer { RayCounters data; };

// Mirrored in vk_backend/memory/scene_addresses.h.
layout(set = 0, binding = 1, scalar) uniform SceneAddresses {
#define DECLARE_ADDRESS(Type, name) name##_buffer name;
    SCENE_BUFFERS(DECLARE_ADDRESS)
#undef DECLARE_ADDRESS
#define DECLARE_ADDRESS(Type, name, alignment, access) name##_buffer name;
    DEVICE_ARRAYS(DECLARE_ADDRESS)
#undef DECLARE_ADDRESS
#define DECLARE_ADDRESS(name) name##_buffer name;
    DEVICE_BLOCKS(DECLARE_ADDRESS)
#undef DECLARE_ADDRESS
} addresses;

layout(set = 0, binding = 2, scalar) uniform Constants { RenderConstants constants; };

#define DEFINE_LOAD(Type, name) \
    Type load_##name(uint index) { return addresses.name.data[index]; }
SCENE_BUFFERS(DEFINE_LOAD)
#undef DEFINE_LOAD

#endif
