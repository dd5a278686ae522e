#include "structures/instance_groups.h"

#include <algorithm>
#include <numeric>

namespace diptych::core {
namespace {

// The custom index of an instance has 24 bits. It holds an index into the table plus one; 0 means "none".
constexpr std::size_t most_entries = (std::size_t{1} << 24U) - 1;

struct MeshUse {
    std::uint64_t triangles = 0;
    std::uint64_t standing = 0;  // number of instances that may be grouped
    bool alone = false;          // some instances may not be grouped, so the mesh keeps its bottom level
};

bool stands(const PackedScene& packed, std::size_t instance) {
    return is_shown(packed, instance) && !may_move(packed, instance);
}

std::vector<MeshUse> count_uses(const PackedScene& packed) {
    std::vector<MeshUse> uses(packed.meshes.size());
    for (std::size_t i = 0; i < uses.size(); ++i) {
        const MeshRange& mesh = packed.meshes[i];
        for (std::uint32_t g = mesh.first_geometry; g < mesh.first_geometry + mesh.geometry_count; ++g) {
            uses[i].triangles += packed.geometry_extents[g].triangle_count;
        }
    }
    for (std::size_t i = 0; i < packed.instances.size(); ++i) {
        MeshUse& use = uses[packed.instance_meshes[i]];
        use.standing += stands(packed, i) ? 1 : 0;
        use.alone = use.alone || !stands(packed, i);
    }
    return uses;
}

/// The meshes whose instances are grouped: those whose copies cost least.
std::vector<bool> choose_meshes(const std::vector<MeshUse>& uses, const GroupLimits& limits) {
    const std::uint64_t all =
        std::accumulate(uses.begin(), uses.end(), std::uint64_t{0},
                        [](std::uint64_t sum, const MeshUse& use) { return sum + use.triangles; });
    std::uint64_t left = std::max(limits.copied_triangles, all);
    std::vector<std::size_t> order(uses.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return uses[a].triangles < uses[b].triangles; });
    std::vector<bool> chosen(uses.size(), false);
    for (const std::size_t mesh : order) {
        const MeshUse& use = uses[mesh];
        if (use.standing == 0 || use.triangles == 0 || use.triangles > limits.triangles) {
            continue;
        }
        const std::uint64_t copied = (use.standing - (use.alone ? 0 : 1)) * use.triangles;
        if (copied <= left) {
            left -= copied;
            chosen[mesh] = true;
        }
    }
    return chosen;
}

}  // namespace

InstanceGroups group_instances(const PackedScene& packed, const GroupLimits& limits) {
    const std::vector<MeshUse> uses = count_uses(packed);
    const std::vector<bool> chosen = choose_meshes(uses, limits);
    std::vector<InstanceGroup> groups;
    std::uint64_t triangles = limits.triangles;  // so that the next instance begins a group
    for (std::uint32_t i = 0; i < packed.instances.size(); ++i) {
        const std::uint32_t mesh = packed.instance_meshes[i];
        if (!chosen[mesh] || !stands(packed, i)) {
            continue;
        }
        if (triangles + uses[mesh].triangles > limits.triangles) {
            groups.emplace_back();
            triangles = 0;
        }
        groups.back().instances.push_back(i);
        triangles += uses[mesh].triangles;
    }
    InstanceGroups kept;
    for (InstanceGroup& group : groups) {
        std::size_t entries = 0;
        for (const std::uint32_t i : group.instances) {
            entries += packed.meshes[packed.instance_meshes[i]].geometry_count;
        }
        if (group.instances.size() < 2 || kept.geometries.size() + entries > most_entries) {
            continue;
        }
        group.first_entry = static_cast<std::uint32_t>(kept.geometries.size());
        kept.grouped.resize(packed.instances.size(), 0);
        for (const std::uint32_t i : group.instances) {
            kept.grouped[i] = 1;
            for (std::uint32_t g = 0; g < packed.meshes[packed.instance_meshes[i]].geometry_count; ++g) {
                kept.geometries.emplace_back(i, g);
            }
        }
        kept.groups.push_back(std::move(group));
    }
    return kept;
}

}  // namespace diptych::core
