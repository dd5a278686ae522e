// The scene's acceleration structures: one a mesh or a group of instances, compacted, and one over the instances.
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

/// Of a command that builds structures: an upper level reads lower ones.
inline constexpr std::array uses_of_build = {
    Use{Resource::scene, Unit::build, Effect::read}, Use{Resource::structures, Unit::build, Effect::read},
    Use{Resource::structures, Unit::build, Effect::write}, Use{Resource::build_scratch, Unit::build, Effect::write}};

/// Structures, many to a buffer: those of PackedScene::meshes in order, then the groups'. A mesh without triangles has
/// address 0, and so has one whose instances are all grouped.
struct BottomLevels {
    std::vector<Buffer> storage;
    std::vector<vk::raii::AccelerationStructureKHR> structures;
    std::vector<vk::DeviceAddress> addresses;
    std::vector<float> units;  // mesh_units
    std::uint64_t bytes = 0;
    std::uint64_t built_bytes = 0;  // before compaction
    InstanceGroups groups;
    Buffer grouped_geometries;               // InstanceGroups::geometries, for the shaders
    std::vector<shared::Instance> standing;  // the packed instances as they were built, where there are groups
};

/// Over the packed instances, of which those that are grouped are inactive, and the groups after them. What builds it
/// stays once it has been built a second time.
struct TopLevel {
    Buffer storage;
    vk::raii::AccelerationStructureKHR structure = nullptr;
    std::uint64_t scratch_bytes = 0;
    Buffer scratch;
    Buffer instances;
    std::vector<vk::AccelerationStructureInstanceKHR> described;  // as it was built
    std::uint64_t revision = 0;                                   // of the instances that it describes
};

/// How much memory one batch of builds may take; a mesh that needs more is a batch of its own.
struct BuildLimits {
    std::uint64_t structure_bytes = std::uint64_t{256} << 20U;
    std::uint64_t scratch_bytes = std::uint64_t{128} << 20U;
    std::size_t meshes = 4096;
};

BottomLevels build_bottom_levels(const Gpu& gpu, const PackedScene& packed, const SceneMemory& scene,
                                 const InstanceGroups& groups, const BuildLimits& limits = {});

/// The first grouped instance that is not where it was when its group was built; after packing about another origin
/// that is any of them.
std::optional<std::size_t> first_moved(const PackedScene& packed, const BottomLevels& bottom);

/// Where an instance stands, as builds take it, for vertices divided by `unit`.
vk::TransformMatrixKHR transform_of(const shared::Instance& instance, float unit = 1);

TopLevel build_top_level(const Gpu& gpu, const PackedScene& packed, const BottomLevels& bottom);

/// Builds it anew, in its own memory, where any instance stands elsewhere. Not refitted: a refitted structure's quality
/// depends on all moments before, a built one's on none, and a frame repeated alone must cost and hit what it did in
/// its sequence. Throws Error where the number of instances is another, or one of a group has moved. Nothing that reads
/// it may be in flight.
void move_top_level(const Gpu& gpu, const PackedScene& moment, const BottomLevels& bottom, TopLevel& top);

}  // namespace diptych::core
