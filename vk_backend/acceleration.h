// The scene's acceleration structures: one a mesh, compacted, and one over the instances.
#pragma once

#include <cstdint>
#include <vector>

#include "buffer.h"
#include "pack/packed_scene.h"
#include "scene_memory.h"

namespace diptych {

/// Meshes' structures, many to a buffer, in the order of PackedScene::meshes. A mesh without triangles has address 0.
struct BottomLevels {
    std::vector<Buffer> storage;
    std::vector<vk::raii::AccelerationStructureKHR> structures;
    std::vector<vk::DeviceAddress> addresses;
    std::uint64_t bytes = 0;
    std::uint64_t built_bytes = 0;  // before compaction
};

/// Over the instances. What builds it stays once it has been built a second time.
struct TopLevel {
    Buffer storage;
    vk::raii::AccelerationStructureKHR structure = nullptr;
    std::uint64_t scratch_bytes = 0;
    Buffer scratch;
    Buffer instances;
    std::vector<vk::AccelerationStructureInstanceKHR> described;  // as it was built
    std::uint64_t revision = 0;  // of the instances that it describes
};

/// How much memory one batch of builds may take; a mesh that needs more is a batch of its own.
struct BuildLimits {
    std::uint64_t structure_bytes = std::uint64_t{256} << 20U;
    std::uint64_t scratch_bytes = std::uint64_t{128} << 20U;
    std::size_t meshes = 4096;
};

BottomLevels build_bottom_levels(const Gpu& gpu, const PackedScene& packed, const SceneMemory& scene,
                                 const BuildLimits& limits = {});

TopLevel build_top_level(const Gpu& gpu, const PackedScene& packed, const BottomLevels& bottom);

/// Builds it anew, in its own memory, where any instance stands elsewhere. Not refitted: a refitted structure's quality depends on all
/// moments before, a built one's on none, and a frame repeated alone must cost and hit what it did in its sequence. Throws Error where
/// the number of instances is another. Nothing that reads it may be in flight.
void move_top_level(const Gpu& gpu, const PackedScene& moment, const BottomLevels& bottom, TopLevel& top);

}  // namespace diptych
