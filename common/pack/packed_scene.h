// The flat buffers that both backends read, and what they need of them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "render/settings.h"
#include "scene/scene.h"
#include "scene_buffers.h"
#include "scene_features.h"

namespace diptych {

/// Where one mesh's primitives lie in `geometries`; the unit of a bottom-level acceleration structure.
struct MeshRange {
    std::uint32_t first_geometry = 0;
    std::uint32_t geometry_count = 0;
};

/// What an acceleration structure needs of a geometry beside its shared::Geometry.
struct GeometryExtent {
    std::uint32_t triangle_count = 0;
    std::uint32_t vertex_count = 0;
    bool alpha = false;  // candidate hits must be put to accepts_hit
};

namespace shared {
/// The arrays of scene_buffers.h.
struct SceneBuffers {
#define DECLARE_BUFFER(Type, name) std::vector<Type> name;
    SCENE_BUFFERS(DECLARE_BUFFER)
#undef DECLARE_BUFFER
};
}  // namespace shared

struct PackedScene : shared::SceneBuffers {
    std::vector<MeshRange> meshes;
    std::vector<GeometryExtent> geometry_extents;  // parallel to geometries
    std::vector<std::uint32_t> instance_meshes;    // parallel to instances: index into meshes
    shared::RenderConstants constants{};
    std::vector<std::string> warnings;  // one line each: what was left out because it cannot be rendered
    std::uint32_t features = 0;         // FEATURE_… bits that the scene and the settings need, or all of them if generic
};

/// Bytes of every buffer together.
std::uint64_t buffer_bytes(const PackedScene& packed);

/// Flattens a scene for one render, rebased so that the camera is the origin: what is near it keeps fp32's full precision. Buffers behind features that are left out stay empty. Triangle indices in `triangles` count
/// from their geometry's first vertex. Throws Error where the scene holds more than 32-bit indices can name.
PackedScene pack_scene(const Scene& scene, const RenderSettings& settings);

}  // namespace diptych
