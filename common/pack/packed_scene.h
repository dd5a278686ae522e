// The flat buffers that both backends read, and what they need of them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pack/linear_part.h"
#include "settings/settings.h"
#include "scene/scene.h"
#include "language/scene_buffers.h"
#include "language/scene_features.h"

namespace diptych::core {

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

/// How a mesh's vertices were packed: packed = (file - center) / unit; with `in_world`, packed = world - center.
struct MeshFrame {
    glm::dvec3 center{0};
    double unit = 1;
    glm::dvec3 middle{0};   // of what is packed
    Spread spread;          // of that about its middle
    bool in_world = false;  // of an instance that stands still under a matrix without a good inverse
};

namespace shared {
/// The arrays of scene_buffers.h.
struct SceneBuffers {
#define DECLARE_BUFFER(Type, name) std::vector<Type> name;
    SCENE_BUFFERS(DECLARE_BUFFER)
#undef DECLARE_BUFFER
};
}  // namespace shared

/// A name for the contents of each array: those of one name are equal, whatever copy they are in. 0 names nothing.
struct Revisions {
#define DECLARE_REVISION(Type, name) std::uint64_t name = 0;
    SCENE_BUFFERS(DECLARE_REVISION)
#undef DECLARE_REVISION
};

struct PackedScene : shared::SceneBuffers {
    Revisions revisions;  // for renderers to skip what they have; who writes an array by hand sets its revision to 0
    std::vector<MeshRange> meshes;
    std::vector<GeometryExtent> geometry_extents;  // parallel to geometries
    std::vector<std::uint32_t> instance_meshes;    // parallel to instances: index into meshes
    std::vector<std::uint8_t>
        instance_shown;  // parallel to instances: 0 where no ray may hit it, flat as it is just now
    std::vector<std::uint8_t> instance_moves;  // parallel to instances: 0 where it stands still at every moment
    shared::RenderConstants constants{};
    std::vector<std::string> warnings;  // one line each: what was left out
    std::uint32_t features = 0;   // FEATURE_… bits that the scene and the settings need, or all of them if generic
    bool keeps_previous = false;  // acceleration structures of the moment before stay, for settings.moves

    // For pack_moment alone.
    glm::dvec3 origin{0};                        // world space of the file minus this is ours
    double radius = 1;                           // of the scene as first packed, for picking probabilities
    double environment_luminance = 0;            // mean over the sphere
    double environment_mean = 0;                 // the same where the largest component of its scale is 1
    glm::dvec3 environment_heading{0};           // mean direction of its light in the map's frame; length at most 1
    glm::vec3 environment_tint{0};               // its scale over the largest component; 0 where that is 0
    std::vector<MeshFrame> mesh_frames;          // parallel to meshes
    double reach = 1;                            // the largest distance of any instance from the origin, at least 1
    double least_unit = 1;                       // what is least of any mesh's unit in the world, in any direction
    std::vector<std::uint32_t> scene_instances;  // parallel to instances: index into Scene::instances
    std::vector<double> emitter_means;           // parallel to emissive_triangles: mean luminance of what they emit
    std::vector<double> light_powers;            // what light_table was built from
    std::vector<std::uint32_t> part_of_light;    // parallel to light_powers but for the environment; empty: no clusters
    std::vector<std::uint32_t> tree_lights;      // parallel to leaf_picks: the lights of the light tree, leaf by leaf
    bool tree_was_sought = false;                // and where light_nodes is empty, there is nothing to choose from
    bool moves = false;                          // light_table keeps its size even where all is dark
};

/// Whether rays may hit an instance; one that was added by hand always shows.
inline bool is_shown(const PackedScene& packed, std::size_t instance) {
    return instance >= packed.instance_shown.size() || packed.instance_shown[instance] != 0;
}

/// Whether an instance may stand elsewhere at another moment; one that was added by hand may.
inline bool may_move(const PackedScene& packed, std::size_t instance) {
    return instance >= packed.instance_moves.size() || packed.instance_moves[instance] != 0;
}

/// Bytes of every buffer together.
std::uint64_t buffer_bytes(const PackedScene& packed);

/// Flattens a scene for one render, rebased so that the camera is the origin: what is near it keeps fp32's full
/// precision. Buffers behind features that are left out stay empty. Triangle indices in `triangles` count from their
/// geometry's first vertex. Throws Error where the scene holds more than 32-bit indices can name, or is too large or
/// too small for fp32 (range.h).
PackedScene pack_scene(const Scene& scene, const RenderSettings& settings);

/// Overwrites what moves (MOVING_BUFFERS, the camera, rotation and scale of the environment) with the same scene at
/// another moment; nothing else is touched, and every index and count stays, light ids included. Origin and radius are
/// those of pack_scene, so that a moment depends on no other. Keeps constants.seed. Throws Error where the scene is
/// another one, an environment that was dark or of another tint included, or where something is out of range.
void pack_moment(const Scene& scene, const RenderSettings& settings, PackedScene& packed);

/// A moment in which nothing but the camera is another: pack_moment without a look at the rest.
void pack_view(const Scene& scene, const RenderSettings& settings, PackedScene& packed);

/// Goes on with other settings where no array's size or order depends on them: size, depth, sampler, weights, seed,
/// most integrators. The scene may stand at another moment, which becomes the moment before as well. As pack_scene of
/// it would have it, but for origin, radius, clusters of lights and the form of the light tree, which stay. False, and
/// nothing is done, where pack_scene must run anew: also for a light tree whose lights move, which is formed at rest.
bool repack_settings(const Scene& scene, const RenderSettings& settings, PackedScene& packed);

}  // namespace diptych::core
