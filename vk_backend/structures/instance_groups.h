// Groups of static instances. A few bottom levels hold their triangles in world space, so that a ray traverses one
// tree and is not transformed into the space of every mesh on its way (docs/decisions/0010-groups-of-instances.md).
#pragma once

#include <cstdint>
#include <vector>

#include "pack/packed_scene.h"

namespace diptych::core {

/// A mesh with k instances is built k times. `copied_triangles` bounds the number of additional triangles; the bound
/// is the number of triangles of all meshes if that is larger.
struct GroupLimits {
    std::uint64_t copied_triangles = std::uint64_t{1} << 20U;
    std::uint64_t triangles = std::uint64_t{1} << 22U;  // of one group; bounds the memory of its build
};

struct InstanceGroup {
    std::vector<std::uint32_t> instances;  // indices into the packed instances
    std::uint32_t first_entry = 0;         // index into `geometries`
};

struct InstanceGroups {
    std::vector<InstanceGroup> groups;
    std::vector<std::uint8_t> grouped;      // parallel to the packed instances; empty if there is no group
    std::vector<shared::uvec2> geometries;  // (instance, geometry of its mesh), for every geometry of every group
};

inline bool is_grouped(const InstanceGroups& groups, std::size_t instance) {
    return instance < groups.grouped.size() && groups.grouped[instance] != 0;
}

/// Groups the visible instances that never move, meshes with few triangles first, within the limits.
InstanceGroups group_instances(const PackedScene& packed, const GroupLimits& limits = {});

}  // namespace diptych::core
