// The scene's acceleration structures: one for each mesh or group of instances, compacted, and one over all instances.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "memory/buffer.h"
#include "commands/hazards.h"
#include "structures/instance_groups.h"
#include "structures/mesh_units.h"
#include "pack/packed_scene.h"
#include "memory/scene_memory.h"

namespace diptych::core {

/// The uses of a build command. A top-level build reads bottom levels.
inline constexpr std::array uses_of_build = {
    Use{Resource::scene, Unit::build, Effect::read}, Use{Resource::structures, Unit::build, Effect::read},
    Use{Resource::structures, Unit::build, Effect::write}, Use{Resource::build_scratch, Unit::build, Effect::write}};

/// Bottom levels, many to a buffer: those of PackedScene::meshes in order, then those of the groups. The address is 0
/// for a mesh without triangles and for a mesh whose instances are all grouped.
struct BottomLevels {
    std::vector<Buffer> storage;
    std::vector<vk::raii::AccelerationStructureKHR> structures;
    std::vector<vk::DeviceAddress> addresses;
    std::vector<float> units;  // mesh_units
    std::uint64_t bytes = 0;
    std::uint64_t built_bytes = 0;  // before compaction
    InstanceGroups groups;
    Buffer grouped_geometries;               // InstanceGroups::geometries, for the shaders
    std::vector<shared::Instance> standing;  // the packed instances at the time of the build, if there are groups
};

/// The structure over the packed instances, followed by the groups. Grouped instances are inactive. After the second
/// build, the buffers of a build are kept.
struct TopLevel {
    Buffer storage;
    vk::raii::AccelerationStructureKHR structure = nullptr;
    std::uint64_t scratch_bytes = 0;
    Buffer scratch;
    Buffer instances;
    std::vector<vk::AccelerationStructureInstanceKHR> described;  // at the last build
    std::uint64_t revision = 0;                                   // of the instances at the last build
};

/// Limits of the memory of one batch of builds. A mesh that needs more is a batch of its own. Where memory is short,
/// batches are smaller.
struct BuildLimits {
    std::uint64_t structure_bytes = std::uint64_t{256} << 20U;
    std::uint64_t scratch_bytes = std::uint64_t{128} << 20U;
    std::size_t meshes = 4096;
};

BottomLevels build_bottom_levels(const Gpu& gpu, const PackedScene& packed, const SceneMemory& scene,
                                 const InstanceGroups& groups, const BuildLimits& limits = {});

struct BuildBytes {
    std::uint64_t structure = 0;  // before compaction
    std::uint64_t scratch = 0;
};

/// What the build with the most triangles needs. Nothing has to be on the device yet.
BuildBytes largest_build(const Gpu& gpu, const PackedScene& packed, const InstanceGroups& groups);

/// The first grouped instance that has moved since its group was built. After packing about another origin, all of
/// them have moved.
std::optional<std::size_t> first_moved(const PackedScene& packed, const BottomLevels& bottom);

/// The matrix of an instance for a build, for vertices divided by `unit`.
vk::TransformMatrixKHR transform_of(const shared::Instance& instance, float unit = 1);

TopLevel build_top_level(const Gpu& gpu, const PackedScene& packed, const BottomLevels& bottom);

/// Rebuilds the structure in place if any instance has moved. It is not refitted: the quality of a refitted structure
/// depends on all earlier moments, but a frame rendered alone must cost and hit the same as in its sequence. Throws
/// Error if the number of instances differs or a grouped instance has moved. Nothing that reads the structure may be
/// in flight.
void move_top_level(const Gpu& gpu, const PackedScene& moment, const BottomLevels& bottom, TopLevel& top);

}  // namespace diptych::core
