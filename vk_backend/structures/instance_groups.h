// Instances that stand still, gathered so that a few bottom levels hold their triangles in world space: a ray then
// searches one tree, and is not carried into the space of every mesh it passes
// (docs/decisions/0010-groups-of-instances.md).
#pragma once

#include <cstdint>
#include <vector>

#include "pack/packed_scene.h"

namespace diptych::core {

/// A mesh placed k times is built k times. The triangles that are then there more than once are bounded by this number,
/// or by that of all meshes where they have more.
struct GroupLimits {
    std::uint64_t copied_triangles = std::uint64_t{1} << 20U;
    std::uint64_t triangles = std::uint64_t{1} << 22U;  // of one group, which bounds the memory that its build takes
};

struct InstanceGroup {
    std::vector<std::uint32_t> instances;  // of the packed scene
    std::uint32_t first_entry = 0;         // into `geometries`
};

struct InstanceGroups {
    std::vector<InstanceGroup> groups;
    std::vector<std::uint8_t> grouped;      // parallel to the packed instances, or empty where there is no group
    std::vector<shared::uvec2> geometries;  // (instance, geometry of its mesh) of every geometry of every group
};

inline bool is_grouped(const InstanceGroups& groups, std::size_t instance) {
    return instance < groups.grouped.size() && groups.grouped[instance] != 0;
}

/// Gathers the instances that are shown and that nothing moves; meshes of few triangles first, as long as the limits
/// let them.
InstanceGroups group_instances(const PackedScene& packed, const GroupLimits& limits = {});

}  // namespace diptych::core
